"""One still shot along the board, near: the peg goes, the band follows and thins."""

from worldkit.filming import Film, still


def film(film: Film) -> None:
    """Tell what is shown."""
    film.set("workshop")
    film.panel("side window", (-0.4, 0.35, 0.5), (0.45, 0.45), towards=(0.03, 0, 0.04), strength=1.3, seen=False)
    film.shot(
        still((0.1, -0.3, 0.2), (0.035, 0.0, 0.035), lens_mm=50, focus=0.35, aperture=16),
        until=film.recorded.duration,
    )
