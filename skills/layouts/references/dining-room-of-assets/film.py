"""The room as one would walk into it: the laid table, apples falling into their bowl, then the whole in the light of its lamps."""

from worldkit.filming import Film, along


def film(film: Film) -> None:
    """The table, near and slow, until the fruit lies; then the room, with the crate of vegetables before the rug."""
    film.shot(along([(1.42, -1.46, 1.50), (1.22, -1.32, 1.42)], (0.02, 0.02, 0.83), lens_mm=36), until=0.6, speed=0.3)
    film.shot(along([(2.95, -3.15, 1.90), (2.60, -2.90, 1.76)], (-0.10, -0.15, 0.72), lens_mm=29), until=2.8)
    film.grade(exposure_stops=0.15, contrast=1.06, saturation=1.06, temperature=0.12, vignette=0.2)
