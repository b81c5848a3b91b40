"""Low before the block: the ball falls into the picture, in slow motion where it strikes, and lies in its dent; then nearer, from above."""

from worldkit.filming import Film, along, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop", facing_deg=-60)
    eye = still((0.24, -0.42, 0.22), (0.0, 0.0, 0.1), lens_mm=46, focus=0.5, aperture=8)
    film.shot(eye, until=0.26, speed=0.5)
    film.shot(eye, until=0.34, speed=0.08)
    near = along([(0.2, -0.3, 0.26), (0.13, -0.2, 0.27)], (0.0, 0.0, 0.08), lens_mm=50, focus=0.3, aperture=8)
    film.shot(near, until=film.recorded.duration, speed=0.3)
