"""The match as it is filmed: over the whole pitch, then along with the ball, once from near, in low evening light."""

from worldkit.filming import Film, along, follow


def film(film: Film) -> None:
    """Five shots, all from the same side, so that red always plays to the right."""
    end = film.recorded.duration
    film.mood("golden_hour")
    film.light(azimuth_deg=-130, elevation_deg=18)
    film.set("park", hour="golden_hour", facing_deg=-90)
    film.shot(along([(-6, -17, 8), (2, -15, 6)], (0, 0, 0.3), lens_mm=28), until=min(8.0, end))
    if end > 8:
        film.shot(
            follow("ball", azimuth_deg=(-100, -80), elevation_deg=22, distance=9, lens_mm=35), until=min(24.0, end)
        )
    if end > 24:
        film.shot(
            follow(
                "ball", azimuth_deg=(-75, -105), elevation_deg=9, distance=3.6, lens_mm=50, focus="ball", aperture=5.6
            ),
            until=min(36.0, end),
        )
    if end > 36:
        film.shot(
            follow("ball", azimuth_deg=(-105, -75), elevation_deg=26, distance=10, lens_mm=35), until=min(50.0, end)
        )
    if end > 50:
        film.shot(along([(3, -14, 5), (-6, -16, 9)], (0, 0, 0.3), lens_mm=28), until=end)
