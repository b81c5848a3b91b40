"""A size 7 basketball: orange pebbled leather, black seams in the classic eight-panel layout, air inside."""

import numpy as np

from . import hulls, shapes, texture
from .recipe import Part, Recipe

DIAMETER = 0.243  # m
WALL = 0.004  # m, carcass and cover


def make() -> Recipe:
    """The ball; its mass sits in the wall, so it turns like a shell."""
    ball, cavity = (_sphere(r) for r in (DIAMETER / 2, DIAMETER / 2 - WALL))
    return Recipe(
        key="basketball",
        category="sport",
        description="Basketball, size 7, orange with black seams, inflated",
        metric_height=DIAMETER,
        metric_height_source="FIBA basketball equipment, size 7: circumference 750 to 770 mm",
        mass=0.61,
        mass_source="FIBA basketball equipment, size 7: 580 to 620 g",
        contact={"friction": 0.7, "torsional": 0.004, "rolling": 0.0008, "restitution": 0.77},
        contact_source="rebound 1035-1085 mm from 1800 mm (FIBA): restitution sqrt(1.06/1.80); friction typical of rubber",
        parts=[Part("ball", ball, "leather", density=1100, cavity=cavity)],
        materials={"leather": {"texture": "leather.png", "specular": 0.22, "shininess": 0.25, "roughness": 0.6}},
        recolour=("leather",),
        textures={"leather.png": _leather()},
        texture_levels={"leather.png": 52},
        collision=[hulls.sphere(DIAMETER)],
    )


def _sphere(radius: float):
    profile = shapes.arc((0, 0), radius, -90, 90, 33)
    profile[[0, -1], 0] = 0
    return shapes.lathe(profile, 60, v=np.linspace(0, 1, len(profile)))


def _leather() -> np.ndarray:
    """Two great circles and a pair of bulged loops, as signed distances in radians on the sphere."""
    height, width = 448, 896
    way = texture.sphere_directions(height, width)
    x, y, z = (way[..., k] for k in range(3))
    across = np.hypot(y, z) + 1e-9
    loop = np.abs(x) - (0.50 + 0.24 * (z / across) ** 2)
    slope = np.hypot(*np.gradient(loop)) / (np.pi / height)
    seam = np.minimum(np.minimum(np.abs(z), np.abs(x)), np.abs(loop) / np.maximum(slope, 0.35))
    pebble = np.zeros((height, width))
    rows = 150
    for row in range(rows):  # pebbles in rings of equal spacing, so that the poles are not stretched
        latitude = (row + 0.5) / rows * np.pi - np.pi / 2
        count = max(6, int(2 * rows * np.cos(latitude)))
        band = slice(
            int(height * (0.5 - latitude / np.pi - 0.5 / rows)), int(height * (0.5 - latitude / np.pi + 0.5 / rows)) + 1
        )
        along = (np.arange(width) + 0.5) / width * count + 0.5 * (row % 2)
        pebble[band] = np.maximum(pebble[band], np.abs(np.sin(np.pi * along))[None])
    tone = texture.noise((height, width), 5, slope=1.4)
    base = texture.ramp(0.5 + 0.10 * tone + 0.30 * (pebble - 0.6), ["#8f3c10", "#c65b1c", "#df7a30"])
    base = texture.blend(base, "#6d2c0c", 0.65 * np.exp(-((seam / 0.035) ** 2)))  # the cover dips towards a seam
    return texture.blend(base, "#17120f", texture.edge(seam - 0.017, 0.008))
