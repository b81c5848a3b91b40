"""A park: lawn, a gravel path, a bench, lanterns, broad trees near and far."""

from typing import TYPE_CHECKING

from . import Place, furniture, land, pieces, town

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 40.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a park: lawn, a gravel path, a bench, lanterns, broad trees near and far."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 55, elevation_deg=46)
    film.ground("grass")
    reach = 2.0 * place.radius + 4.0
    land.turf(film, place, height=0.05, look="#7f9a48", reach=reach, count=34_000)
    land.short_turf(film, place, look="#7f9a48")
    x, y, z = place.spot(1.5 * place.radius + 3.2, 180)
    film.draw("path", "box", (300, 1.8, 0.02), pos=(x, y, z + 0.001), yaw_deg=place.yaw_to_camera() + 8, look="sand")
    slats = [pieces.block(1.6, 0.09, 0.03, (0, -0.2 + 0.12 * k, 0.42)) for k in range(4)]
    slats += [pieces.block(1.6, 0.03, 0.09, (0, 0.24, 0.55 + 0.14 * k)) for k in range(3)]
    spot = place.spot(1.5 * place.radius + 5.0, 158)
    furniture.put(film, place, "bench", slats, spot, "wood_oak")
    feet = [pieces.block(0.05, 0.5, 0.42, (side, 0, 0)) for side in (-0.7, 0.7)]
    feet += [pieces.block(0.05, 0.04, 0.5, (side, 0.26, 0.42)) for side in (-0.7, 0.7)]
    furniture.put(film, place, "bench's feet", feet, spot, "steel_dark")
    for number, (away, turn) in enumerate(((place.radius + 2.6, 68.0), (1.4 * place.radius + 4.2, 203.0))):
        town.park_lamp(film, place, number + 1, place.spot(away, turn))
    land.wood(film, place, "broadleaf", 9, reach + 5, reach + 28, 9.0, "trees")
    land.wood(film, place, "broadleaf", 10, reach + 26, reach + 46, 10.0, "far trees")
    land.edge_of_a_wood(film, place, away=62 + 2 * place.radius, height=13.0)
    land.range_of_hills(film, place, away=220 + 3 * place.radius, height=30, look="#54683f", name="hills", rough=0.3)
