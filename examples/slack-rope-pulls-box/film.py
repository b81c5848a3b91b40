"""A rope that hangs, is drawn taut, and pulls: all of it from the side, the rope near as it tightens."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.set("workshop", facing_deg=-75)
    film.light(azimuth_deg=-145, elevation_deg=34, colour="#ffe2b8", softness_deg=3)
    film.grade(contrast=1.1, vignette=0.3)
    end = film.recorded.duration
    film.shot(still((0.4, -3.6, 0.7), (0.2, 0, 0.3), lens_mm=40), until=0.8)
    film.shot(still((0.5, -1.9, 0.52), (0.4, 0, 0.33), lens_mm=45, focus="trolley", aperture=5.6), until=1.5, speed=0.4)
    film.shot(still((1.5, -3.9, 0.7), (0.8, 0, 0.28), lens_mm=38), until=end)
