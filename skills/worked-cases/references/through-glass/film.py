"""Near and level with the glass: what passes behind is seen in it, upside down and the other way."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.panel("side window", (-0.55, 0.2, 0.45), (0.45, 0.5), towards=(0, 0, 0.05), strength=1.4, seen=False)
    film.shot(
        still((0.03, -0.42, 0.085), (0.0, 0.02, 0.045), lens_mm=60, focus=0.44, aperture=16),
        until=film.recorded.duration,
    )
