"""A red apple: five soft lobes, dimples at stem and calyx, a bent stem."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe
from .surface import Surface

OUTLINE = [  # (radius, z), bottom dimple to stem dimple, m
    (0.0, 0.0068), (0.006, 0.0045), (0.013, 0.0008), (0.0195, 0.0008), (0.0270, 0.0075), (0.0335, 0.0200),
    (0.0375, 0.0360), (0.0372, 0.0500), (0.0320, 0.0625), (0.0225, 0.0690), (0.0140, 0.0680), (0.0070, 0.0620), (0.0, 0.0560),
]  # fmt: skip


def make() -> Recipe:
    """The apple; the collision hull is the flesh without its dimples, plus the stem."""
    flesh, stem = _flesh(), _stem()
    return Recipe(
        key="apple",
        category="food",
        description="Red apple with a stem",
        metric_height=0.079,
        metric_height_source="typical medium apple: 7.5 cm across, 7 cm high without the stem",
        mass=0.17,
        mass_source="medium apple, USDA FoodData Central: 161 g to 182 g",
        contact={"friction": 0.45, "restitution": 0.35, "torsional": 0.003, "rolling": 0.0006},
        contact_source="waxy fruit on wood: friction 0.4 to 0.5, restitution 0.3 to 0.5; rolling resistance of soft flesh",
        parts=[
            Part("flesh", flesh, "skin", density=840, crease_deg=70),
            Part("stem", stem, "stem", density=600, crease_deg=60),
        ],
        materials={
            "skin": {"texture": "skin.png", "specular": 0.42, "shininess": 0.5, "roughness": 0.35},
            "stem": {"rgba": [0.32, 0.21, 0.12, 1.0], "specular": 0.1, "shininess": 0.1, "roughness": 0.9},
        },
        recolour=("skin",),
        textures={"skin.png": _skin()},
        texture_levels={"skin.png": 64},
        collision=[hulls.Hull(shapes.hull(_flesh(11, 20).vertices)), hulls.Hull(shapes.hull(stem.vertices))],
    )


def _flesh(rings: int = 34, segments: int = 56) -> Surface:
    profile = shapes.curve(OUTLINE, rings)
    profile[[0, -1], 0] = 0
    profile[:, 0] = np.maximum(profile[:, 0], 0)
    body = shapes.lathe(profile, segments, v=np.linspace(0, 1, len(profile)))
    x, y, z = body.vertices.T
    angle, t = np.arctan2(y, x), np.clip(z / 0.07, 0, 1)
    lobes = 1 + (0.030 * (1 - t) ** 2 + 0.012 * t**2) * np.cos(5 * angle + 0.4) + 0.012 * np.cos(angle - 1.0)
    lift = 0.0011 * np.cos(5 * angle + 0.4) * np.exp(-((z / 0.012) ** 2)) + 0.0012 * np.cos(angle + 2) * t
    return body.mapped(np.column_stack([x * lobes, y * lobes, z - lift * (np.hypot(x, y) > 0.004)]))


def _stem() -> Surface:
    path = shapes.curve(
        [(0, 0, 0.0545), (0.0008, 0.0002, 0.062), (0.0028, 0.0008, 0.071), (0.0065, 0.0018, 0.0785)], 12
    )
    thickness = np.interp(np.linspace(0, 1, 12), [0, 0.2, 0.75, 1], [1.3, 0.95, 1.0, 1.75])
    return shapes.sweep(path, shapes.arc((0, 0), 0.00135, 0, 360, 11)[:-1], side=(0, 1, 0), scale=thickness)


def _skin() -> np.ndarray:
    """Red streaks over yellow, which shows through around the stem and on one shaded side."""
    height, width = 384, 512
    v = 1 - (np.arange(height)[:, None] + 0.5) / height
    u = (np.arange(width)[None] + 0.5) / width
    streak = texture.noise((height, width), 41, slope=0.9, stretch=(1, 12)) * 0.8
    streak += texture.noise((height, width), 42, slope=0.5, stretch=(1, 30)) * 0.5
    broad = texture.noise((height, width), 43, slope=2.2)
    shaded = np.exp(-((((u - 0.62 + 0.5) % 1 - 0.5) / 0.16) ** 2)) * np.exp(-(((v - 0.55) / 0.3) ** 2))
    red = 0.80 + 0.10 * streak + 0.09 * broad - 0.38 * shaded
    red -= 0.95 * np.exp(-(((v - 1.0) / 0.105) ** 2)) + 0.30 * np.exp(-(((v - 0.0) / 0.10) ** 2))
    picture = texture.ramp(red, ["#8d9440", "#c9b84a", "#d8863a", "#c5362a", "#a81c20", "#86121a"])
    dots = texture.edge(2.9 - texture.noise((height, width), 44, slope=0.2), 0.5) * (v > 0.2)
    picture = texture.blend(picture, "#e2c07a", 0.55 * dots)
    return texture.blend(picture, "#6a5a2a", 0.75 * np.exp(-(((v - 1.0) / 0.045) ** 2)) * np.ones_like(u))
