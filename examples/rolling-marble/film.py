"""A marble as large as it wants: before it at table height as it comes between the mugs, then from the side as it goes on."""

from worldkit.filming import Film, follow


def film(film: Film) -> None:
    film.set("living_room", facing_deg=-60)
    film.light(azimuth_deg=-145, elevation_deg=22, colour="#ffd6a0", softness_deg=1.5)
    film.grade(contrast=1.1, vignette=0.3)
    end = film.recorded.duration
    film.shot(
        follow(
            "marble", azimuth_deg=(-14, -24), elevation_deg=15, distance=0.26, lens_mm=50, focus="marble", aperture=11
        ),
        until=1.6,
        speed=0.5,
    )
    film.shot(
        follow(
            "marble", azimuth_deg=(-30, -50), elevation_deg=22, distance=0.32, lens_mm=50, focus="marble", aperture=11
        ),
        until=end,
        speed=0.6,
    )
