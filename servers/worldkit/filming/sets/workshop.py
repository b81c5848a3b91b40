"""A workshop: concrete floor, a bench with a vice, tools on a board, crates, timber, a lamp over the bench."""

from typing import TYPE_CHECKING

import numpy as np

from . import Place, furniture, hours, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 4.0


def build(film: "Dressing", place: Place) -> None:
    """Draw a workshop: concrete floor, a bench with a vice, tools on a board, crates, timber, a lamp over the bench."""
    film.light(
        azimuth_deg=place.facing_deg - 70,
        elevation_deg=30,
        colour="#ffe6c6",
        strength=1.25,
        softness_deg=2.5,
        fill=0.36,
    )
    film.grade(contrast=1.08, saturation=0.95, temperature=0.05, vignette=0.24)
    hours.through_window(film, place)
    film.ground("concrete")
    away = max(2.6, place.radius + 1.8)
    furniture.walls(film, place, away, high=3.4, wall="brick")
    spot = place.spot(away - 0.5, 180)
    furniture.put(
        film,
        place,
        "bench",
        [pieces.block(2.4, 0.75, 0.08, (0, 0, 0.82)), pieces.block(2.2, 0.6, 0.04, (0, 0, 0.22))],
        spot,
        "wood_pine",
    )
    furniture.put(
        film,
        place,
        "bench's legs",
        [pieces.block(0.1, 0.1, 0.82, (x, y, 0)) for x in (-1.1, 1.1) for y in (-0.3, 0.3)],
        spot,
        "wood_oak",
    )
    furniture.put(
        film,
        place,
        "vice",
        [
            pieces.block(0.2, 0.12, 0.14, (0.8, -0.32, 0.9)),
            pieces.block(0.2, 0.06, 0.1, (0.8, -0.45, 0.92)),
            pieces.block(0.02, 0.3, 0.02, (0.8, -0.5, 0.94)),
        ],
        spot,
        "steel_dark",
    )
    wall = place.spot(away, 180)
    furniture.put(film, place, "tool board", [pieces.block(1.9, 0.03, 0.9, (0, -0.09, 1.25))], wall, "wood_maple")
    tools = []
    for x in np.linspace(-0.8, 0.8, 11):
        long = place.random.uniform(0.2, 0.5)
        tools += [
            pieces.block(0.03, 0.025, long, (x, -0.13, 2.05 - long), 0.01),
            pieces.block(place.random.uniform(0.05, 0.13), 0.03, 0.06, (x, -0.13, 2.05 - long), 0.01),
        ]
    furniture.put(film, place, "tools", tools, wall, "steel_brushed")
    for number, turn in enumerate((228.0, 219.0, 224.0)):
        up = 0.0 if number < 2 else 0.42
        furniture.put(
            film,
            place,
            f"crate {number + 1}",
            [pieces.block(0.5, 0.5, 0.4, radius=0.01)],
            place.spot(away + 0.2, turn, up),
            "wood_pine",
            place.random.uniform(-12, 12),
        )
    planks = [pieces.block(0.14, 0.03, place.random.uniform(1.9, 2.5), (0.17 * k, 0.03 * k, 0)) for k in range(5)]
    furniture.put(film, place, "timber", planks, place.spot(away - 0.2, 146), "wood_planks_pale")
