"""A lake among wooded hills, still water behind a grassy shore."""

from typing import TYPE_CHECKING

import numpy as np

from . import Place, land

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 50.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a lake among wooded hills, still water behind a grassy shore."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg - 100, elevation_deg=28, colour="#ffe3bd")
    film.ground("grass")
    shore = 1.4 * place.radius + 4.0
    land.water(film, place, shore=shore, name="lake", beyond=220.0)
    land.turf(film, place, height=0.12, look="#788c46", reach=(shore - 0.6) / 2.5, count=22_000)
    land.short_turf(film, place, look="#788c46", count=8_000)
    land.stones(
        film,
        place,
        np.array([place.spot(shore + place.random.uniform(-1, 0.6), 180 + t)[:2] for t in np.linspace(-75, 75, 60)]),
        (0.05, 0.28),
    )
    sides = [place.spot(1.35 * shore + place.random.uniform(0, 9), turn)[:2] for turn in (96, 104, 113, 247, 256, 264)]
    film.tree("spruces", "conifer", at=sides, height=9.0, z=place.floor)
    land.range_of_hills(film, place, away=150, height=34, look="#3f5538", name="far shore", rough=0.5)
    land.range_of_hills(film, place, away=260, height=80, look="#5f7484", name="mountains", rough=1.0)
