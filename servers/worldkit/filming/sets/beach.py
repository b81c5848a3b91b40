"""A beach in the late afternoon: sand, the sea to the horizon, a parasol, a towel, dune grass."""

from typing import TYPE_CHECKING

from ..drawn_only import Surface
from . import Place, furniture, land, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 60.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a beach in the late afternoon: sand, the sea to the horizon, a parasol, a towel, dune grass."""
    film.mood("noon")
    film.light(azimuth_deg=place.facing_deg + 125, elevation_deg=32, colour="#ffe2b8", strength=1.15)
    film.sky(zenith="#3f74c8", horizon="#cfe0ee", ground="#b9a988", clouds=0.3, glow=0.5)
    film.ground("sand")
    shore = 1.5 * place.radius + 6.0
    land.water(film, place, shore=shore, name="sea")
    for number, away in enumerate((shore + 0.6, shore + 3.5)):
        x, y, z = place.spot(away, 180, 0.03)
        film.draw(
            f"surf {number + 1}",
            "ellipsoid",
            (500, 0.5 + 0.2 * number, 0.06),
            pos=(x, y, z),
            yaw_deg=place.yaw_to_camera(),
            look="snow",
        )
    land.stones(
        film,
        place,
        place.around(90, place.radius + 0.4, shore - 1),
        (0.01, 0.05),
        look="stone",
        name="pebbles and shells",
    )
    spot = place.spot(place.radius + 3.4, 145)
    furniture.put(film, place, "parasol's pole", [pieces.block(0.035, 0.035, 2.1)], spot, "wood_pine")
    cloth = pieces.turned([(0.0, 0.42), (0.55, 0.32), (1.15, 0.0), (1.13, 0.0), (0.54, 0.30), (0.0, 0.40)], smooth=2)
    furniture.put(
        film, place, "parasol", [(cloth[0] + [0, 0, 1.75], cloth[1])], spot, Surface(colour="#d8553f", roughness=0.9)
    )
    towel = place.spot(place.radius + 3.0, 160, 0.008)
    film.draw("towel", "box", (0.9, 1.8, 0.015), pos=towel, yaw_deg=place.yaw_to_camera() + 25, look="fabric_blue")
