"""Two ladders in a park: both in one picture all the time, the blow slowly, the fall from below."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.set("park", facing_deg=-40)
    film.light(azimuth_deg=-70, elevation_deg=32, colour="#ffe6c0", softness_deg=1)
    film.grade(contrast=1.08, vignette=0.2)
    film.shot(still((5.2, -4.6, 1.5), (0.6, 0, 1.05), lens_mm=33), until=0.45, speed=0.5)
    film.shot(still((4.3, -3.7, 0.7), (0.5, 0, 1.35), lens_mm=32), until=1.6, speed=0.5)
    film.shot(still((5.2, -4.6, 1.5), (0.9, 0, 0.85), lens_mm=33), until=film.recorded.duration)
