"""The bank of a small river: pebbles, reeds, water with the far bank and trees behind."""

from typing import TYPE_CHECKING

import numpy as np

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 30.0


def build(film: "Dressing", place: Place) -> None:
    """The bank of a small river: pebbles, reeds, water with the far bank and trees behind."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 50, elevation_deg=40)
    film.ground("grass")
    shore = 1.3 * place.radius + 1.6
    land.water(film, place, shore=shore, name="river", beyond=9.0)
    spots = np.array(
        [place.spot(shore + place.random.uniform(-1.4, 0.3), 180 + t)[:2] for t in place.random.uniform(-80, 80, 150)]
    )
    land.stones(film, place, spots, (0.02, 0.22), name="pebbles")
    land.turf(film, place, height=0.1, look="#788c46", reach=shore / 2.5, count=18_000)
    land.short_turf(film, place, look="#788c46", count=8_000)
    x, y, z = place.spot(shore + 9 + 30, 180, 0.0)
    film.draw("far bank", "box", (240, 60, 0.5), pos=(x, y, z), yaw_deg=place.yaw_to_camera(), look="grass")
    land.wood(film, place, "broadleaf", 12, shore + 12, shore + 34, 9.0, "trees on the far bank", free_deg=230)
    land.edge_of_a_wood(film, place, away=64 + 2 * place.radius, count=110)
    land.range_of_hills(film, place, away=200, height=30, look="#54683f", name="hills", rough=0.3)
