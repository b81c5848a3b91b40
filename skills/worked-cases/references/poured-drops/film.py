"""The rigid drops as one smooth surface, near, on a kitchen counter, in light that grazes it."""

from worldkit.filming import Film, Surface, orbit


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.surface("caramel", of="drop_*", look=Surface(colour="#b4651a", roughness=0.16))
    film.panel("side window", (-0.5, 0.55, 0.5), (0.5, 0.5), towards=(0, 0, 0.03), strength=0.8, seen=False)
    film.grade(exposure_stops=-0.25)
    film.shot(
        orbit(
            (0, 0, 0.055),
            azimuth_deg=(-70, -48),
            elevation_deg=(24, 30),
            distance=0.52,
            lens_mm=60,
            focus=0.5,
            aperture=11,
        ),
        until=film.recorded.duration,
        speed=0.6,
    )
