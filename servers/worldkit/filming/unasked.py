"""The film of a run whose author wrote none, a `film.py` like any other: where it is by the plan's words, then the event."""

from worldkit.filming import Film, hero, whereabouts


def film(film: Film) -> None:
    """Put the world into a place that suits it, and show what happens."""
    recorded = film.recorded
    azimuth, _ = hero.view(recorded)
    if recorded.setting == "outdoor" and whereabouts.own_land(recorded):
        whereabouts.countryside(film, azimuth)
    elif name := whereabouts.choose(recorded):
        film.set(name, facing_deg=azimuth, hour=whereabouts.hour(recorded))
        if recorded.floor:  # the plan says what the ground is
            film.ground(recorded.floor)
    if any(recorded.wind[:2]):
        film.breeze()
    film.usual()
