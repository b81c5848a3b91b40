"""From above and in front, in low light from the side, which shows the relief: two streams sway, the paints run and blend."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop")
    film.panel("side window", (-0.6, 0.1, 0.35), (0.5, 0.4), towards=(0, 0, 0.06), strength=1.3, seen=False)
    eye = still((0.1, -0.52, 0.5), (0.0, 0.0, 0.09), lens_mm=42)
    film.shot(eye, until=film.recorded.duration)
