"""A bowling ball: marbled polyester with three finger holes, fifteen pounds."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe

DIAMETER = 0.2170  # m
LOOKS = {
    "blue": ["#081b4d", "#123b8f", "#3f74d8"],
    "red": ["#4d0508", "#98121b", "#d8433f"],
    "black": ["#050506", "#17171b", "#3b3b44"],
}


def make() -> Recipe:
    """The ball; the swirl and the holes make its rolling visible."""
    profile = shapes.arc((0, 0), DIAMETER / 2, -90, 90, 41)
    profile[[0, -1], 0] = 0
    ball = shapes.lathe(profile, 72, v=np.linspace(0, 1, len(profile)))
    return Recipe(
        key="bowling_ball",
        category="sport",
        description="Bowling ball, marbled, with finger holes; looks: blue, red, black",
        metric_height=DIAMETER,
        metric_height_source="USBC equipment specifications: diameter 8.500 to 8.595 in",
        mass=6.8,
        mass_source="a 15 lb ball; USBC equipment specifications: at most 16 lb",
        contact={"friction": 0.2, "torsional": 0.002, "rolling": 0.0003, "restitution": 0.65},
        contact_source="USBC: friction on the lane at most 0.32, restitution against a pin 0.605 to 0.735",
        parts=[Part("ball", ball, "cover", density=1270)],
        materials={"cover": {"texture": "cover_blue.png", "specular": 0.7, "shininess": 0.85, "roughness": 0.1}},
        recolour=("cover",),
        textures={f"cover_{name}.png": _cover(stops) for name, stops in LOOKS.items()},
        texture_levels={f"cover_{name}.png": 64 for name in LOOKS},
        looks={name: {"cover": {"texture": f"cover_{name}.png"}} for name in LOOKS},
        default_look="blue",
        collision=[hulls.sphere(DIAMETER)],
    )


def _cover(stops: list[str]) -> np.ndarray:
    height, width = 320, 640
    way = texture.sphere_directions(height, width)
    swirl = texture.noise((height, width), 41, slope=1.7, stretch=(1, 2))
    fine = texture.noise((height, width), 42, slope=1.1)
    picture = texture.ramp(np.clip(0.45 + 0.22 * np.sin(3.2 * swirl + 4 * way[..., 2]) + 0.06 * fine, 0, 1), stops)
    for x, y in ((0.10, 0.11), (0.10, -0.11), (-0.22, 0.0)):  # two fingers and the thumb, on top
        hole = np.hypot(way[..., 0] - x, way[..., 1] - y)
        hole = np.where(way[..., 2] > 0, hole, 9.0)
        picture = texture.blend(picture, "#060607", texture.edge(hole - (0.105 if x > 0 else 0.125), 0.012))
    return picture
