"""Near and level with the glass, the light behind it: the cork dips in, bobs up, and lies still."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.panel("side window", (-0.55, 0.25, 0.45), (0.45, 0.5), towards=(0, 0, 0.07), strength=1.3, seen=False)
    eye = still((0.06, -0.52, 0.145), (0.0, 0.0, 0.066), lens_mm=60, focus=0.53, aperture=16)
    film.shot(eye, until=0.6, speed=0.4)
    film.shot(eye, until=film.recorded.duration)
