"""A dolly beside the wave, as fast as it; then its end again, slowly, from where the last one falls to."""

from worldkit.filming import Film, along, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("kitchen_counter")
    film.shot(
        along(
            [(-0.36, -0.40, 0.17), (-0.06, -0.36, 0.13), (0.16, -0.34, 0.11)],
            "domino_6",
            lens_mm=35,
            focus="domino_6",
            aperture=11,
        ),
        until=0.72,
        speed=0.5,
    )
    film.shot(
        still((0.53, -0.17, 0.07), (0.17, 0.0, 0.045), lens_mm=50, focus="domino_9", aperture=8),
        start=0.45,
        until=1.1,
        speed=0.3,
    )
