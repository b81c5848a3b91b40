"""A clearing in a spruce wood on a misty morning, with stones and ferns of grass."""

from typing import TYPE_CHECKING

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 25.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a clearing in a spruce wood on a misty morning, with stones and ferns of grass."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg + 140, elevation_deg=30, strength=1.1)
    film.sky(zenith="#8fa5b5", horizon="#dfe5e0", ground="#5c5a4a", glow=0.5)
    film.fog(colour="#ccd5d2", visibility_m=150.0, height_m=30.0)
    film.grade(contrast=1.08, saturation=0.95, vignette=0.2)
    film.ground("soil")
    reach = 1.6 * place.radius + 3.0
    land.turf(film, place, height=0.14, look="#8aa35a", reach=reach + 4, count=26_000)
    land.stones(film, place, place.around(18, place.radius + 1.0, reach + 6), (0.15, 0.8))
    land.wood(film, place, "conifer", 16, reach + 2, reach + 14, 13.0, "spruces")
    land.wood(film, place, "conifer", 22, reach + 14, reach + 45, 15.0, "far spruces", free_deg=80)
