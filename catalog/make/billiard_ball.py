"""A pool ball: phenolic resin, sixteen looks (`cue` with spots that show spin, `1` to `15`)."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe

DIAMETER = 0.05715  # m
IVORY = "#f4eddc"
COLOURS = ("#f3b51b", "#1f46ad", "#d6251f", "#5b2a86", "#f0701a", "#12703f", "#7c1d24", "#17171a")


def make() -> Recipe:
    """The ball; the stripe, the number and the cue ball's spots make its rolling visible."""
    profile = shapes.arc((0, 0), DIAMETER / 2, -90, 90, 31)
    profile[[0, -1], 0] = 0
    ball = shapes.lathe(profile, 56, v=np.linspace(0, 1, len(profile)))
    pictures = {f"ball_{n}.png": _numbered(n) for n in range(1, 16)}
    looks = {"cue": {"resin": {"texture": "ball_cue.png"}}}
    looks |= {str(n): {"resin": {"texture": f"ball_{n}.png"}} for n in range(1, 16)}
    return Recipe(
        key="billiard_ball",
        category="sport",
        description="Pool ball, 57.15 mm, phenolic resin; looks: cue, 1 to 15",
        metric_height=DIAMETER,
        metric_height_source="WPA equipment specifications: diameter 2 1/4 in (57.15 mm)",
        mass=0.17,
        mass_source="WPA equipment specifications: 5 1/2 to 6 oz (156 to 170 g)",
        contact={"friction": 0.06, "torsional": 0.001, "rolling": 0.00002, "restitution": 0.95},
        contact_source="ball on ball: Marlow, The Physics of Pocket Billiards (1995): friction 0.03-0.08, restitution 0.92-0.98",
        parts=[Part("ball", ball, "resin", density=1700)],
        materials={"resin": {"texture": "ball_11.png", "specular": 0.7, "shininess": 0.85, "roughness": 0.12}},
        recolour=("resin",),
        textures=pictures | {"ball_cue.png": _cue()},
        looks=looks,
        default_look="11",
        collision=[hulls.sphere(DIAMETER)],
    )


def _numbered(number: int) -> np.ndarray:
    height, width = 256, 512
    way = texture.sphere_directions(height, width)
    paint = texture.colour(COLOURS[(number - 1) % 8])
    picture = np.broadcast_to(paint, way.shape).copy()
    if number > 8:
        picture = texture.blend(picture, IVORY, texture.edge(0.54 - np.abs(way[..., 2]), 0.02))
    for side in (1, -1):  # the number stands on +X and on -X
        disc = np.hypot(way[..., 1], way[..., 2])
        disc = np.where(way[..., 0] * side > 0, disc, 9)
        picture = texture.blend(picture, IVORY, texture.edge(disc - 0.4, 0.02))
    for column in (0, width // 2):
        patch = np.roll(picture, width // 2 - column, axis=1)
        size = 50 if number < 10 else 44
        patch = texture.lettering(patch, str(number), (width / 2, height / 2), size, "#151515", 800)
        if number in (6, 9):
            y, x = np.mgrid[0:height, 0:width]
            bar = np.maximum(np.abs(x - width / 2) - 12, np.abs(y - height / 2 - 24) - 1.5)
            patch = texture.blend(patch, "#151515", texture.edge(bar, 1.5))
        picture = np.roll(patch, column - width // 2, axis=1)
    return picture


def _cue() -> np.ndarray:
    way = texture.sphere_directions(256, 512)
    picture = np.broadcast_to(texture.colour(IVORY), way.shape).copy()
    for axis in range(3):
        off = np.sqrt(np.clip(1 - way[..., axis] ** 2, 0, 1))
        picture = texture.blend(picture, "#c8201f", texture.edge(off - 0.17, 0.02))
    return picture
