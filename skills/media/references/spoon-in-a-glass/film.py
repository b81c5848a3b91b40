"""Near and a little above the rim, the light behind the glass; then down on the surface, as it turns."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.panel("side window", (-0.55, 0.25, 0.45), (0.45, 0.5), towards=(0, 0, 0.07), strength=1.3, seen=False)
    side = still((0.05, -0.4, 0.13), (0.0, 0.0, 0.058), lens_mm=60, focus=0.45, aperture=16)
    above = still((0.03, -0.26, 0.3), (0.0, 0.0, 0.07), lens_mm=50, focus=0.35, aperture=16)
    film.shot(side, until=1.8)
    film.shot(above, until=film.recorded.duration)
