"""The whole arm first, then the fingers at the mug, then the shelf."""

from worldkit.filming import Film, follow, orbit, still


def film(film: Film) -> None:
    """Three shots from one side."""
    film.set("workshop", facing_deg=-90)
    film.shot(orbit((0.28, 0.1, 0.16), azimuth_deg=(-62, -48), elevation_deg=16, distance=1.4, lens_mm=38), until=2.2)
    film.shot(
        follow("mug", azimuth_deg=(-50, -35), elevation_deg=12, distance=0.55, lens_mm=50, focus="mug", aperture=5.6),
        until=7.2,
    )
    film.shot(still((1.05, -0.6, 0.5), (0.2, 0.15, 0.2), lens_mm=42), until=film.recorded.duration)
