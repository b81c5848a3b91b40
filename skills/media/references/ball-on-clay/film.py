"""Low before the block: the ball falls into the picture, in slow motion where it strikes, and lies in its dent; then nearer, from above."""

from worldkit.filming import Film, along, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop", facing_deg=-60)
    eye = still((0.32, -0.62, 0.3), (0.0, 0.0, 0.14), lens_mm=44, focus="ball", aperture=8)
    film.shot(eye, until=0.26, speed=0.5)
    film.shot(eye, until=0.34, speed=0.08)
    near = along([(0.24, -0.4, 0.32), (0.17, -0.29, 0.31)], (0.0, 0.0, 0.085), lens_mm=44, focus="ball", aperture=8)
    film.shot(near, until=film.recorded.duration, speed=0.3)
