"""The film of a run whose author wrote none, a `film.py` like any other: where it is by the plan's words, then the event."""

from worldkit.filming import Film, hero


def film(film: Film) -> None:
    """Put the world into a place that suits it, and show what happens."""
    azimuth, _ = hero.view(film.recorded)
    film.usual_set(facing_deg=azimuth)
    film.usual()
