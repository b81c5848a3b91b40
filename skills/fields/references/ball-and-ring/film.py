"""Near and level with the ring: the ball sinks by a millimetre, and is through; the fall slowed."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop")
    film.panel("side window", (-0.5, 0.4, 0.5), (0.5, 0.5), towards=(0, 0, 0.15), strength=1.3, seen=False)
    eye = still((0.17, -0.5, 0.25), (0.03, 0.0, 0.125), lens_mm=50, focus=0.52, aperture=16)
    through = film.recorded.event()
    film.shot(eye, until=max(0.5, through - 0.35), speed=2.0)
    film.shot(eye, until=min(through + 0.1, film.recorded.duration), speed=0.3)
    film.shot(eye, until=film.recorded.duration)
