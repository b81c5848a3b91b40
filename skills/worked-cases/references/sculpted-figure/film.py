"""The duck in a living room, near the floor, as a child sees it."""

from worldkit.filming import Film, orbit


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("living_room")
    film.panel("side window", (-1.2, -1.4, 1.3), (1.0, 1.2), towards=(0, 0, 0.1), strength=1.6, seen=False)
    film.shot(
        orbit(
            "duck", azimuth_deg=(-62, -38), elevation_deg=(9, 14), distance=0.82, lens_mm=50, focus="duck", aperture=8
        ),
        until=film.recorded.duration,
    )
