"""One shot: a dolly beside the wave, as fast as it, until the last one lies."""

from worldkit.filming import Film, along


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.shot(
        along(
            [(-0.46, -0.42, 0.17), (-0.06, -0.42, 0.13), (0.24, -0.46, 0.11)],
            "domino_8",
            lens_mm=35,
            focus="domino_8",
            aperture=11,
        ),
        until=1.1,
        speed=0.4,
    )
