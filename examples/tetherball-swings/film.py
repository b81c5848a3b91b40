"""A tetherball in a park: the serve, the blow slowly from beside the glove, the turns with the pole whole, low against the trees."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.set("park", facing_deg=-50)
    film.light(azimuth_deg=-110, elevation_deg=30, colour="#ffe2b6", softness_deg=1)
    film.grade(contrast=1.08, saturation=1.05, vignette=0.2)
    end = film.recorded.duration
    film.shot(still((4.6, -3.4, 1.3), (0.9, -0.1, 1.35), lens_mm=38), until=0.36, speed=0.5)
    film.shot(
        still((3.3, -1.9, 1.35), (1.7, -0.15, 1.42), lens_mm=50, focus="ball", aperture=5.6), until=0.62, speed=0.15
    )
    film.shot(still((4.9, -4.4, 1.0), (0.0, 0, 1.62), lens_mm=32), until=end)
