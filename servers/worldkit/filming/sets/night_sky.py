"""Open land under a starry night, the last light on the horizon."""

from typing import TYPE_CHECKING

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 200.0


def build(film: "Dressing", place: Place) -> None:
    """Open land under a starry night, the last light on the horizon."""
    film.mood("night")
    film.sky(zenith="#05070f", horizon="#1d2a48", ground="#0c0e12", stars=1.0, glow=0.15)
    film.light(azimuth_deg=place.facing_deg + 130, elevation_deg=40, strength=0.55)
    film.ground("grass")
    reach = 1.8 * place.radius + 4.0
    land.turf(film, place, height=0.12, look="#8a9a6a", reach=reach, count=26_000)
    land.wood(film, place, "conifer", 12, reach + 10, reach + 40, 11.0, "spruces")
    land.range_of_hills(film, place, away=200 + 3 * place.radius, height=38, look="#1b2230", name="hills", rough=0.6)
