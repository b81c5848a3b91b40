"""One low shot over the water, against the light: the stone falls in, the rings run out to the leaf."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("park")
    film.light(azimuth_deg=100, elevation_deg=32, strength=1.0)
    eye = still((0.55, -1.75, 0.95), (0.12, 0.1, 0.36), lens_mm=32)
    film.shot(eye, until=0.35)
    film.shot(eye, until=0.95, speed=0.35)
    film.shot(eye, until=film.recorded.duration)
