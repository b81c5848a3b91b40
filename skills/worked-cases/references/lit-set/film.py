"""A workshop at night: what is not near the lamp is only guessed."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop")
    film.sky(zenith="#10141d", horizon="#1a202b", ground="#0d0e10", glow=0.0, strength=0.5)
    film.light(strength=0.05, colour="#9fb6d8", elevation_deg=35, softness_deg=8)
    film.lamp(
        "bench lamp",
        (-0.42, -0.45, 0.95),
        strength=2.6,
        colour="#ffc484",
        aim=(0.02, -0.03, 0.2),
        cone_deg=34,
        radius=0.04,
    )
    film.panel(
        "moonlit window", (1.1, 0.7, 1.2), (0.7, 0.9), towards=(0, 0, 0.3), strength=0.5, colour="#8fb0e0", seen=False
    )
    film.grade(contrast=1.06, vignette=0.3, glow=0.12)
    film.shot(
        still((0.72, -1.42, 0.46), (0.0, 0.0, 0.27), lens_mm=50, focus="pendulum", aperture=5.6),
        until=film.recorded.duration,
    )
