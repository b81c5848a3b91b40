"""From low in the grass: it takes off, is shaken by gusts, and flies on over the path."""

from worldkit.filming import Film, follow


def film(film: Film) -> None:
    """Three shots from one side."""
    film.set("park", facing_deg=-90)
    film.shot(
        follow("cf21b", azimuth_deg=-75, elevation_deg=(4, -6), distance=0.75, lens_mm=50, focus="cf21b", aperture=4),
        until=4.0,
    )
    film.shot(
        follow("cf21b", azimuth_deg=(-60, -95), elevation_deg=4, distance=1.1, lens_mm=40, focus="cf21b", aperture=4),
        until=8.2,
    )
    film.shot(
        follow("cf21b", azimuth_deg=(-105, -70), elevation_deg=8, distance=0.7, lens_mm=60, focus="cf21b", aperture=4),
        until=film.recorded.duration,
    )
