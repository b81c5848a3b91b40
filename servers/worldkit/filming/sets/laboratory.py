"""A laboratory bench: the ground is its top, pale and clean; glassware, a stand, a rack of tubes, cupboards behind."""

from typing import TYPE_CHECKING

import numpy as np

from ..drawn_only import Surface
from . import Place, furniture, hours, pieces

if TYPE_CHECKING:
    from ..dressing import Dressing

WIDEST = 1.2


def build(film: "Dressing", place: Place) -> None:
    """Draw a laboratory bench: the ground is its top, pale and clean; glassware, a stand, a rack of tubes, cupboards behind."""
    film.light(
        azimuth_deg=place.facing_deg - 58, elevation_deg=29, colour="#fff4e4", strength=1.25, softness_deg=2, fill=0.36
    )
    film.grade(contrast=1.04, saturation=0.96, temperature=-0.04, vignette=0.14)
    hours.through_window(film, place)
    film.ground("plastic_white")
    back = place.radius + 0.45
    spot = place.spot(back, 180)
    furniture.put(
        film,
        place,
        "wall",
        [pieces.block(5.0, 0.05, 2.4, (0, 0.6, 0), 0.002)],
        spot,
        Surface(colour="#dfe5e8", roughness=0.8),
    )
    for k in range(4):
        furniture.put(
            film,
            place,
            f"cupboard {k + 1}",
            [pieces.block(0.78, 0.34, 0.7, (-1.2 + 0.8 * k, 0.4, 0.75), 0.006)],
            spot,
            Surface(colour="#f2f3f2", roughness=0.4),
        )
        furniture.put(
            film,
            place,
            f"cupboard handle {k + 1}",
            [pieces.block(0.2, 0.015, 0.015, (-1.2 + 0.8 * k, 0.22, 0.8))],
            spot,
            "steel_brushed",
        )
    furniture.put(
        film,
        place,
        "stand",
        [
            pieces.block(0.22, 0.14, 0.02, (-0.55, 0, 0)),
            pieces.block(0.014, 0.014, 0.6, (-0.6, 0.0, 0.02)),
            pieces.block(0.2, 0.014, 0.014, (-0.5, 0, 0.42)),
        ],
        spot,
        "steel_dark",
    )
    flask = [(0, 0), (0.05, 0), (0.055, 0.012), (0.018, 0.11), (0.016, 0.15), (0.02, 0.155)]
    for number, (side, look) in enumerate(((0.38, "#3f7fd0"), (0.56, "#e0a53a"), (0.72, "#5fb36b"))):
        furniture.put(
            film,
            place,
            f"flask {number + 1}",
            [pieces.placed(pieces.turned([*flask, (0, 0.155)]), (side, 0.02 * number, 0))],
            spot,
            Surface(colour="#e9f2f4", roughness=0.05, opacity=0.35),
        )
        furniture.put(
            film,
            place,
            f"liquid {number + 1}",
            [
                pieces.placed(
                    pieces.turned([(0, 0.002), (0.048, 0.003), (0.05, 0.014), (0.034, 0.06), (0, 0.06)]),
                    (side, 0.02 * number, 0),
                )
            ],
            spot,
            Surface(colour=look, roughness=0.1),
        )
    furniture.put(
        film, place, "rack", [pieces.block(0.3, 0.07, 0.012, (0.05, 0.1, z)) for z in (0.0, 0.07)], spot, "wood_maple"
    )
    tubes = [
        pieces.placed(
            pieces.turned([(0, 0.014), (0.008, 0.012), (0.008, 0.13), (0, 0.13)], smooth=0), (0.05 + x, 0.1, 0)
        )
        for x in np.linspace(-0.12, 0.12, 6)
    ]
    furniture.put(film, place, "test tubes", tubes, spot, Surface(colour="#cfe4f0", roughness=0.05, opacity=0.55))
