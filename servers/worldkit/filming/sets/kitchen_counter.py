"""A kitchen: the ground is the counter's top; tiles behind it, jars, a board with a knife, a pan on the wall."""

from typing import TYPE_CHECKING

from ..drawn_only import Surface
from . import Place, furniture, hours, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 0.9


def build(film: "Dressing", place: Place) -> None:
    """Draw a kitchen: the ground is the counter's top; tiles behind it, jars, a board with a knife, a pan on the wall."""
    film.light(
        azimuth_deg=place.facing_deg - 60, elevation_deg=28, colour="#ffe6c6", strength=1.25, softness_deg=2, fill=0.36
    )
    film.grade(contrast=1.04, temperature=0.04, vignette=0.16)
    hours.through_window(film, place)
    film.ground("wood_oak")
    back = place.radius + 0.32
    furniture.put(
        film, place, "tiles", [pieces.block(4.0, 0.04, 0.62, (0, 0.05, 0), 0.002)], place.spot(back, 180), "tiles_white"
    )
    furniture.put(
        film,
        place,
        "wall",
        [pieces.block(4.0, 0.04, 1.6, (0, 0.06, 0.62), 0.002)],
        place.spot(back, 180),
        Surface(colour="#c9d3c6", roughness=0.9),
    )
    furniture.put(
        film, place, "rail", [pieces.block(2.4, 0.02, 0.03, (0, -0.0, 0.63))], place.spot(back, 180), "steel_brushed"
    )
    jar = [(0, 0), (0.052, 0), (0.056, 0.01), (0.056, 0.13), (0.04, 0.15), (0, 0.15)]
    for number, (side, look) in enumerate(((-0.62, "#8a5a2e"), (-0.48, "#d8c9a0"), (-0.35, "#7a3b22"))):
        scale = place.random.uniform(0.85, 1.25)
        mesh = pieces.placed(pieces.turned(jar), (side, -0.06, 0), scale=scale)
        furniture.put(
            film, place, f"jar {number + 1}", [mesh], place.spot(back, 180), Surface(colour=look, roughness=0.25)
        )
        lid = pieces.placed(
            pieces.turned([(0, 0.15), (0.043, 0.15), (0.043, 0.18), (0, 0.18)], smooth=0),
            (side, -0.06, 0.15 * scale),
            scale=scale,
        )
        furniture.put(film, place, f"lid {number + 1}", [lid], place.spot(back, 180), "cork")
    board = [pieces.block(0.3, 0.02, 0.42, (0.46, 0.0, 0), 0.008)]
    furniture.put(film, place, "chopping board", board, place.spot(back, 180), "wood_walnut")
    bowl = pieces.turned([(0, 0), (0.05, 0), (0.13, 0.075), (0.125, 0.078), (0.045, 0.012), (0, 0.012)])
    furniture.put(film, place, "bowl", [pieces.placed(bowl, (0.78, -0.08, 0))], place.spot(back, 180), "ceramic_blue")
    lemons = [
        pieces.placed((0.03 * ball[0] * [1.25, 1, 1], ball[1]), (0.78 + dx, -0.08 + dy, 0.06), yaw)
        for ball in (pieces.ball(2),)
        for dx, dy, yaw in ((-0.035, 0.0, 10), (0.035, 0.01, 80), (0.0, 0.045, 40), (0.0, -0.03, 120))
    ]
    furniture.put(film, place, "lemons", lemons, place.spot(back, 180), "lemon_peel")
