"""Near and level with the spoon, the window behind it: the honey creeps to the lip, runs down in a thread, and mounds in the jar."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("still_life", facing_deg=-90, colour="#e6d3b0")
    film.surface("honey_skin", of="honey", look="clear #c98a18 5mm", smooth=1.3)
    film.panel("side window", (-0.5, 0.35, 0.4), (0.5, 0.5), towards=(0, 0, 0.08), strength=1.4, seen=False)
    eye = still((0.03, -0.78, 0.22), (0.035, 0.0, 0.12), lens_mm=62, focus=0.78, aperture=11)
    film.shot(eye, until=film.recorded.duration)
