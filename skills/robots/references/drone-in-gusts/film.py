"""From low in the grass: it takes off, is shaken by gusts, and flies on over the path."""

from worldkit.filming import Film, follow, still


def film(film: Film) -> None:
    """Three shots from one side."""
    film.set("park", facing_deg=-90)
    film.shot(
        follow("cf21b", azimuth_deg=-75, elevation_deg=(4, -6), distance=0.75, lens_mm=50, focus="cf21b", aperture=4),
        until=4.0,
    )
    film.shot(still((0.8, -1.35, 0.95), (0.78, 0.1, 1.06), lens_mm=32, focus="cf21b", aperture=4), until=8.2)
    film.shot(
        follow("cf21b", azimuth_deg=(-105, -70), elevation_deg=8, distance=0.7, lens_mm=60, focus="cf21b", aperture=4),
        until=film.recorded.duration,
    )
