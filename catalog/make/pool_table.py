"""A nine-foot pool table: slate bed under green cloth, cushions, walnut rails, turned-looking legs. Long side along X.

The bed collides as one flat box, so the six pockets are drawn but hold nothing.
"""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe, Support
from .surface import join

LENGTH, WIDTH = 2.54, 1.27  # m, playing surface between the cushion noses
BED, NOSE = 0.762, 0.0365  # m, height of the cloth and of the cushion nose above it
CUSHION, RAIL = 0.050, 0.130  # m, depth of cushion and rail outside the noses
TOP = BED + 0.043  # m, top of the rails
SLATE = 0.045
POCKET = 0.062  # m, radius
TILE = 0.6
CORNERS = [(sx * (LENGTH / 2 + 0.012), sy * (WIDTH / 2 + 0.012)) for sx in (-1, 1) for sy in (-1, 1)]
SIDES = [(0.0, sy * (WIDTH / 2 + 0.038)) for sy in (-1, 1)]


def _cushions() -> list[tuple[tuple[float, float], tuple[float, float]]]:
    """(centre, extents) in the plane of the six cushion runs, stopped short of the pockets."""
    gap, side = 0.075, 0.068
    run = (LENGTH / 2 - gap - side) if gap else 0.0
    long = [
        ((sx * (side + run / 2), sy * (WIDTH / 2 + CUSHION / 2)), (run, CUSHION)) for sx in (-1, 1) for sy in (-1, 1)
    ]
    ends = [((sx * (LENGTH / 2 + CUSHION / 2), 0.0), (CUSHION, WIDTH - 2 * gap)) for sx in (-1, 1)]
    return long + ends


def make() -> Recipe:
    """The table; bed, cushions, rails and legs collide as exact boxes."""
    outer_x, outer_y = LENGTH + 2 * (CUSHION + RAIL), WIDTH + 2 * (CUSHION + RAIL)
    inner_x, inner_y = LENGTH + 2 * CUSHION, WIDTH + 2 * CUSHION
    bed = shapes.rounded_box((inner_x, inner_y, SLATE), 0.002, 1).moved(0, 0, BED - SLATE / 2).box_uv(TILE, "x")
    cushions = [
        shapes.rounded_box((*size, NOSE), 0.009, 3).moved(*at, BED + NOSE / 2).box_uv(TILE, "x")
        for at, size in _cushions()
    ]
    height = 0.075
    rails = [
        shapes.rounded_box((outer_x, RAIL, height), 0.014, 3)
        .moved(0, s * (outer_y - RAIL) / 2, TOP - height / 2)
        .box_uv(TILE, "x", (0, 0.3 * s))
        for s in (-1, 1)
    ] + [
        shapes.rounded_box((RAIL, inner_y + 0.02, height), 0.010, 3)
        .moved(s * (outer_x - RAIL) / 2, 0, TOP - height / 2)
        .box_uv(TILE, "y", (0, 0.4 * s))
        for s in (-1, 1)
    ]
    skirt = [
        shapes.rounded_box((outer_x - 0.16, 0.035, 0.17), 0.006, 2)
        .moved(0, s * (outer_y / 2 - 0.10), BED - 0.12)
        .box_uv(TILE, "x", (0, 0.2 * s))
        for s in (-1, 1)
    ] + [
        shapes.rounded_box((0.035, outer_y - 0.22, 0.17), 0.006, 2)
        .moved(s * (outer_x / 2 - 0.10), 0, BED - 0.12)
        .box_uv(TILE, "y", (0, 0.2 * s))
        for s in (-1, 1)
    ]
    under = BED - 0.10
    feet = [(sx * (outer_x / 2 - 0.24), sy * (outer_y / 2 - 0.20)) for sx in (-1, 1) for sy in (-1, 1)]
    legs = [
        shapes.tapered_box((0.095, 0.095), (0.165, 0.165), (0.0, under), 0.012)
        .moved(x, y)
        .box_uv(TILE, "z", (0.3 * x, 0.2 * y))
        for x, y in feet
    ]
    disc = shapes.lathe(np.array([(0.0, 0.0), (POCKET, 0.0), (POCKET, 0.0012), (0.0, 0.0012)]), 40)
    pockets = [disc.moved(x, y, BED + 0.0008) for x, y in CORNERS + SIDES]
    return Recipe(
        key="pool_table",
        category="furniture",
        description="Nine-foot pool table, green cloth, walnut rails; its pockets are drawn, the bed is flat",
        metric_height=TOP,
        metric_height_source="WPA equipment specifications: bed 74.3 to 78.7 cm above the floor, nose 62.5 to 64.5 % of a ball",
        mass=380.0,
        mass_source="nine-foot slate tables weigh 320 to 450 kg (manufacturers' data sheets)",
        contact={"friction": 0.2, "restitution": 0.75, "torsional": 0.002, "rolling": 0.0002},
        contact_source="Marlow, The Physics of Pocket Billiards (1995): ball on cloth 0.2, rolling 0.005 to 0.015 of the radius; cushion restitution 0.6 to 0.9",
        parts=[
            Part("bed", bed, "cloth", density=2700),
            Part("cushions", join(cushions), "cloth", density=1100),
            Part("rails", join(rails), "walnut", density=640),
            Part("skirt", join(skirt), "walnut", density=640),
            Part("legs", join(legs), "walnut", density=640),
            Part("pockets", join(pockets), "hole", density=0),
        ],
        materials={
            "cloth": {"texture": "cloth.png", "specular": 0.04, "shininess": 0.05, "roughness": 0.95},
            "walnut": {"texture": "walnut.png", "specular": 0.3, "shininess": 0.45, "roughness": 0.35},
            "hole": {"rgba": [0.012, 0.012, 0.014, 1.0], "specular": 0.0, "shininess": 0.0, "roughness": 1.0},
        },
        recolour=("cloth",),
        textures={
            "cloth.png": texture.cloth(256, 71, ["#0d5b37", "#12703f", "#178149"]),
            "walnut.png": texture.wood(512, 72, ["#2b170c", "#472713", "#65391c", "#7d4a26"], rings=9),
        },
        texture_levels={"cloth.png": 48, "walnut.png": 64},
        collision=[
            hulls.box((inner_x, inner_y, SLATE), (0, 0, BED - SLATE / 2), name="bed"),
            *[
                hulls.box((*size, NOSE), (*at, BED + NOSE / 2), name=f"cushion_{i}")
                for i, (at, size) in enumerate(_cushions())
            ],
            *[
                hulls.box((outer_x, RAIL, height), (0, s * (outer_y - RAIL) / 2, TOP - height / 2), name=n)
                for s, n in ((1, "rail_left"), (-1, "rail_right"))
            ],
            *[
                hulls.box((RAIL, inner_y, height), (s * (outer_x - RAIL) / 2, 0, TOP - height / 2), name=n)
                for s, n in ((1, "rail_front"), (-1, "rail_back"))
            ],
            *[hulls.box((0.12, 0.12, under), (x, y, under / 2)) for x, y in feet],
        ],
        supports=[Support("bed", BED, (LENGTH, WIDTH), default=True)],
    )
