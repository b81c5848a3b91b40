"""One still shot, near and level: the gap closes slowly, and then at once."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop")
    film.panel("side window", (-0.6, 0.5, 1.25), (0.5, 0.6), towards=(0, 0, 0.76), strength=1.4, seen=False)
    arrives = film.recorded.event()
    eye = still((0.01, -0.3, 0.83), (-0.012, 0.0, 0.757), lens_mm=60, focus=0.31, aperture=16)
    film.shot(eye, until=arrives - 0.12)
    film.shot(eye, until=arrives + 0.05, speed=0.15)
    film.shot(eye, until=film.recorded.duration)
