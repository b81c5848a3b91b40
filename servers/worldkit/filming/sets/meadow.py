"""A summer meadow: grass that differs, blossoms, a tree or two, woods and hills behind."""

from typing import TYPE_CHECKING

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 60.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a summer meadow: grass that differs, blossoms, a tree or two, woods and hills behind."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 60, elevation_deg=42)
    film.ground("grass")
    reach = 2.2 * place.radius + 4.0
    land.turf(film, place, height=0.16, look="#6d8a3c", reach=reach)
    land.turf(film, place, height=0.3, look="#8a9a4e", reach=2 * reach, name="tall grass", count=30_000)
    land.flowers(film, place, ("#f3f1e2", "#e8c63a", "#b45a8c"), reach)
    land.wood(film, place, "broadleaf", 7, reach + 6, reach + 30, 8.0, "trees")
    land.range_of_hills(film, place, away=140 + 3 * place.radius, height=26, look="#6f8a55", name="hills", rough=0.3)
