"""One shot from the open side, level with the rails; slow while the cloth takes the blow."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("gym")
    eye = still((0.9, -3.1, 1.75), (0.0, 0.0, 1.05), lens_mm=38, focus="ball", aperture=5.6)
    meets = film.recorded.event()
    film.shot(eye, until=max(0.1, meets - 0.15))
    film.shot(eye, until=meets + 0.5, speed=0.35)
    film.shot(eye, until=film.recorded.duration)
