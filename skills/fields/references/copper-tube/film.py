"""One still place that holds the tube from over its mouth to the mat: the slug is down at once, the magnet still on its way."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.panel("side window", (-0.5, 0.3, 0.5), (0.5, 0.5), towards=(0, 0, 0.1), strength=1.4, seen=False)
    eye = still((-0.1, -0.5, 0.17), (-0.018, 0.0, 0.086), lens_mm=50, focus=0.51, aperture=16)
    film.shot(eye, until=0.25, speed=0.3)
    film.shot(eye, until=film.recorded.duration)
