"""Near and level with the pane, from behind it: the ball comes, the pane bursts in slow motion, its shards fall."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("living_room")
    eye = still((0.8, 2.05, 1.35), (0.0, 0.0, 1.12), lens_mm=32)
    film.shot(eye, until=0.1, speed=0.4)
    film.shot(eye, until=0.3, speed=0.15)
    film.shot(eye, until=film.recorded.duration, speed=0.6)
