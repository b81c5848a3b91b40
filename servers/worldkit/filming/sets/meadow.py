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
    land.turf(film, place, height=0.15, look="#66803a", reach=reach, count=36_000)
    land.turf(film, place, height=0.32, look="#83904c", reach=1.5 * reach, name="tall grass", count=13_000)
    land.short_turf(film, place, look="#66803a")
    land.flowers(film, place, ("#f3f1e2", "#e8c63a", "#b45a8c"), reach)
    land.wood(film, place, "broadleaf", 5, reach + 10, reach + 34, 9.0, "trees")
    land.edge_of_a_wood(film, place, away=70 + 2 * place.radius)
    land.range_of_hills(film, place, away=140 + 3 * place.radius, height=26, look="#6f8a55", name="hills", rough=0.3)
