"""A sports hall: a court with lines, wall bars, a bench, mats and balls, high windows of light."""

from typing import TYPE_CHECKING

from . import Place, furniture, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 14.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a sports hall: a court with lines, wall bars, a bench, mats and balls, high windows of light."""
    film.light(
        azimuth_deg=place.facing_deg - 65, elevation_deg=55, colour="#fffaf0", strength=0.95, softness_deg=6, fill=0.6
    )
    film.grade(contrast=1.05, vignette=0.16)
    film.ground("wood_court")
    away = max(4.0, 1.2 * place.radius + 3.0)
    furniture.walls(film, place, away, high=6.0, wall="#cfd3cc", side=1.4 * away)
    yaw = place.yaw_to_camera()
    for number, (deep, look) in enumerate(((0.75, "plastic_white"), (0.45, "plastic_blue"))):
        film.draw(
            f"line {number + 1}",
            "box",
            (4 * away, 0.05, 0.004),
            pos=place.spot(deep * away, 180, 0.002),
            yaw_deg=yaw,
            look=look,
        )
    wall = place.spot(away, 180)
    for number, side in enumerate((-1.6, 0.0, 1.6)):
        bars = [pieces.block(0.9, 0.04, 0.035, (side, -0.14, 0.2 + 0.18 * k), 0.015) for k in range(13)]
        bars += [pieces.block(0.05, 0.12, 2.6, (side + x, -0.1, 0)) for x in (-0.45, 0.45)]
        furniture.put(film, place, f"wall bars {number + 1}", bars, wall, "wood_pine")
    furniture.put(
        film,
        place,
        "bench",
        [
            pieces.block(2.6, 0.24, 0.045, (0, 0, 0.3)),
            pieces.block(0.06, 0.22, 0.3, (-1.0, 0, 0)),
            pieces.block(0.06, 0.22, 0.3, (1.0, 0, 0)),
        ],
        place.spot(away - 0.7, 205),
        "wood_maple",
    )
    furniture.put(
        film,
        place,
        "mats",
        [pieces.block(2.0, 1.2, 0.2, (0.03 * k, 0.02 * k, 0.21 * k), 0.04) for k in range(3)],
        place.spot(away - 0.9, 150),
        "fabric_blue",
        12,
    )
    for number, (turn, look) in enumerate(
        ((166.0, "leather_brown"), (172.0, "leather_black"), (199.0, "leather_brown"))
    ):
        film.draw(f"medicine ball {number + 1}", "sphere", 0.28, pos=place.spot(away - 0.5, turn, 0.14), look=look)
