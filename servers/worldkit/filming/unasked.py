"""The film of a run whose author wrote none, a `film.py` like any other: where it is by the plan's words, then the event."""

from worldkit import materials
from worldkit.filming import Film, hero, whereabouts


def film(film: Film) -> None:
    """Put the world into a place that suits it, and show what happens."""
    recorded = film.recorded
    azimuth, _ = hero.view(recorded)
    if recorded.setting == "outdoor" and whereabouts.own_land(recorded):
        whereabouts.countryside(film, azimuth)
    elif name := whereabouts.choose(recorded):
        film.set(name, facing_deg=azimuth, hour=whereabouts.hour(recorded))
    if any(recorded.wind[:2]):
        film.breeze()
    for body in recorded.grains:  # a liquid or snow is one thing to the eye, whatever points it is reckoned with
        look = recorded.looks.get(body, "")
        if look == "snow" or (look and materials.look(look).clear > 0):
            film.surface(f"{body} as one", of=body, look=look, smooth=2.0 if look == "snow" else 1.0)
    film.usual()
