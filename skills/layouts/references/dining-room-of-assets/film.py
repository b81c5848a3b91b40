"""The room as one would walk into it: the crate by the door, the laid table, the whole in the light of its lamps."""

from worldkit.filming import Film, along, still


def film(film: Film) -> None:
    """Two near shots, then the room."""
    end = film.recorded.duration
    film.shot(
        still((1.55, -2.25, 0.85), (0.75, -1.35, 0.12), lens_mm=40, focus="crate", aperture=5.6), until=0.6, speed=0.3
    )
    film.shot(along([(1.25, -1.25, 1.40), (0.85, -1.20, 1.36)], (0.05, 0.0, 0.82), lens_mm=40), until=1.5, speed=0.4)
    film.shot(along([(3.0, -3.0, 1.95), (2.55, -2.75, 1.80)], (-0.15, 0.05, 0.80), lens_mm=30), until=end)
    film.hold(along([(2.55, -2.75, 1.80), (2.35, -2.60, 1.74)], (-0.15, 0.05, 0.80), lens_mm=30), 1.5)
    film.grade(exposure_stops=0.15, contrast=1.06, saturation=1.06, temperature=0.12, vignette=0.2)
