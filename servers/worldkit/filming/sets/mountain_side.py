"""High up: bare rock and boulders, short turf, a few spruces, a range of snowy peaks in the haze."""

from typing import TYPE_CHECKING

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 120.0


def build(film: "Dressing", place: Place) -> None:
    """High up: bare rock and boulders, short turf, a few spruces, a range of snowy peaks in the haze."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 65, elevation_deg=38, strength=1.15)
    film.fog(colour="#cfdcea", visibility_m=1500.0)
    film.ground("grass")
    reach = 1.8 * place.radius + 4.0
    land.turf(film, place, height=0.07, look="#8b9258", reach=reach, count=22_000)
    land.short_turf(film, place, look="#8b9258", count=8_000)
    land.stones(film, place, place.around(26, place.radius + 1.2, reach + 14), (0.2, 1.6))
    land.stones(film, place, place.around(60, 0.6 * place.radius + 0.8, reach), (0.03, 0.14), name="scree")
    land.wood(film, place, "conifer", 12, reach + 8, reach + 50, 9.0, "spruces")
    land.range_of_hills(
        film, place, away=95 + 3 * place.radius, height=22, look="#5c6b4c", name="near ridge", rough=0.6
    )
    land.range_of_hills(film, place, away=190 + 4 * place.radius, height=80, look="rock", name="peaks", rough=1.4)
    land.range_of_hills(film, place, away=280 + 4 * place.radius, height=135, look="snow", name="snow peaks", rough=1.4)
