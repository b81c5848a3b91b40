"""An oak dining table: rounded top, apron, tapered legs. Its long side runs along X."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import Surface, join

LENGTH, WIDTH, HEIGHT, TOP = 1.60, 0.90, 0.75, 0.032  # m
LEG, FOOT = 0.075, 0.050  # m, square section under the apron and at the floor
LEG_AT = (LENGTH / 2 - 0.085, WIDTH / 2 - 0.085)
TILE = 0.62  # m of table per texture


def make() -> Recipe:
    """The table; collision is exact boxes for the top and the apron, hulls for the tapered legs."""
    under = HEIGHT - TOP
    corners = shapes.box_corners(np.array([LENGTH - 0.05, WIDTH - 0.05, TOP - 0.016])) + (0, 0, HEIGHT - TOP / 2)
    rim = np.concatenate([np.column_stack([shapes.arc((0, 0), 0.017, 0, 360, 17)[:-1], np.full(16, 0.0)])])
    top = shapes.rounded_hull((corners[:, None] + rim[None]).reshape(-1, 3), 0.008, 2).box_uv(TILE, "x")
    leg = shapes.tapered_box((FOOT, FOOT), (LEG, LEG), (0.0, under), 0.006)
    legs = [
        leg.moved(sx * LEG_AT[0], sy * LEG_AT[1]).box_uv(TILE, "z", (0.31 * sx, 0.17 * sy + 0.4 * sx))
        for sx in (-1, 1)
        for sy in (-1, 1)
    ]
    apron = [
        shapes.rounded_box((2 * LEG_AT[0] - LEG + 0.01, 0.022, 0.09), 0.002, 1)
        .moved(0, s * (LEG_AT[1] + 0.012), under - 0.045)
        .box_uv(TILE, "x", (0, 0.2 * s))
        for s in (-1, 1)
    ] + [
        shapes.rounded_box((0.022, 2 * LEG_AT[1] - LEG + 0.01, 0.09), 0.002, 1)
        .moved(s * (LEG_AT[0] + 0.012), 0, under - 0.045)
        .box_uv(TILE, "y", (0, 0.3 * s))
        for s in (-1, 1)
    ]
    return Recipe(
        key="table",
        category="furniture",
        description="Oak dining table for six, long side along x",
        metric_height=HEIGHT,
        metric_height_source="typical dining table: 74 to 76 cm high, 160 x 90 cm",
        mass=38.0,
        mass_source="volume of the parts in oak at 700 kg/m^3 (The Wood Database: red and white oak 700 to 755 kg/m^3)",
        contact={"friction": 0.45, "restitution": 0.45},
        contact_source="wood on wood, dry: friction 0.25 to 0.5 (Engineering ToolBox); restitution of hardwood 0.4 to 0.6",
        parts=[
            Part("top", top, "oak", density=700),
            Part("legs", join(legs), "oak", density=700),
            Part("apron", join(apron), "oak", density=700),
        ],
        materials={"oak": {"texture": "oak.png", "specular": 0.22, "shininess": 0.35, "roughness": 0.45}},
        recolour=("oak",),
        textures={"oak.png": texture.wood(512, 51, ["#6d4522", "#9a6a38", "#bd8c53", "#d2a76d"], rings=11)},
        texture_levels={"oak.png": 64},
        collision=[
            hulls.box((LENGTH, WIDTH, TOP), (0, 0, HEIGHT - TOP / 2), name="top"),
            *[
                hulls.box((2 * LEG_AT[0], 0.022, 0.09), (0, s * (LEG_AT[1] + 0.012), under - 0.045), name=n)
                for s, n in ((1, "apron_left"), (-1, "apron_right"))
            ],
            *[
                hulls.box((0.022, 2 * LEG_AT[1], 0.09), (s * (LEG_AT[0] + 0.012), 0, under - 0.045), name=n)
                for s, n in ((1, "apron_front"), (-1, "apron_back"))
            ],
            *[_leg(sx, sy, under) for sx in (1, -1) for sy in (1, -1)],
        ],
        supports=[Support("top", HEIGHT, (LENGTH - 0.04, WIDTH - 0.04), default=True)],
    )


def _leg(sx: int, sy: int, under: float) -> hulls.Hull:
    ends = ((FOOT - 0.004, 0.0), (LEG, under))
    points = [(x * s / 2, y * s / 2, z) for s, z in ends for x in (-1, 1) for y in (-1, 1)]
    surface: Surface = shapes.hull(np.array(points)).moved(sx * LEG_AT[0], sy * LEG_AT[1])
    return hulls.Hull(surface, name=f"leg_{'front' if sx > 0 else 'back'}_{'left' if sy > 0 else 'right'}")
