"""One still shot that holds the tube from mouth to mat: the slug is down at once, and the magnet is still on its way."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.panel("side window", (-0.5, 0.3, 0.5), (0.5, 0.5), towards=(0, 0, 0.1), strength=1.4, seen=False)
    film.shot(
        still((-0.12, -0.46, 0.15), (-0.02, 0.0, 0.083), lens_mm=60, focus=0.47, aperture=16),
        until=film.recorded.duration,
    )
