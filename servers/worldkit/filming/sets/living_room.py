"""A living room: a sofa, a rug, books, a lamp that is lit, pictures, a plant, daylight from a window."""

from typing import TYPE_CHECKING

from . import Place, furniture, hours

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 2.2


def build(film: "Dressing", place: Place) -> None:
    """Draw a living room: a sofa, a rug, books, a lamp that is lit, pictures, a plant, daylight from a window."""
    film.light(
        azimuth_deg=place.facing_deg - 75,
        elevation_deg=29,
        colour="#ffe6c6",
        strength=1.25,
        softness_deg=2.5,
        fill=0.36,
    )
    film.grade(contrast=1.04, temperature=0.05, vignette=0.18)
    hours.through_window(film, place)
    film.ground("wood_planks")
    away = max(2.4, place.radius + 1.9)
    furniture.walls(film, place, away, wall="#d8cfc0")
    rug = place.spot(0.0, 0.0, 0.004)
    film.draw(
        "rug",
        "box",
        (2 * place.radius + 2.0, 2 * place.radius + 1.4, 0.008),
        pos=rug,
        yaw_deg=place.yaw_to_camera(),
        look="carpet",
    )
    furniture.sofa(film, place, place.spot(away - 0.6, 180))
    furniture.shelf(film, place, place.spot(away + 0.35, 222))
    furniture.lamp(film, place, place.spot(away + 0.15, 150))
    furniture.plant(film, place, place.spot(away + 0.6, 134))
    furniture.picture(film, place, place.spot(away - 0.07, 180, 1.35), 1.0, 0.62)
