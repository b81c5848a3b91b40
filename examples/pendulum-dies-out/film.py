"""A pendulum on a sill before a painted wall: some swings, the brass near, and the end, which is what the sentence says."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    film.set("still_life", facing_deg=-70, colour="#5b6f66")
    film.grade(contrast=1.1, vignette=0.3)
    film.shot(still((0.45, -0.95, 0.3), (0, 0, 0.215), lens_mm=44, focus="bob", aperture=8), until=4.0)
    film.shot(still((0.3, -0.5, 0.18), (0, 0, 0.19), lens_mm=60, focus="bob", aperture=8), until=7.0)
    film.shot(
        still((0.45, -0.95, 0.3), (0, 0, 0.215), lens_mm=44, focus="bob", aperture=8), until=film.recorded.duration
    )
