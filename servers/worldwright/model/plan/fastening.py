"""Where the end of a rope or spring is fastened, in numbers: arithmetic on the plan and its layout."""

import math

from .committed import Plan
from .drives import End
from .layout import Scene
from .scene_objects import Vec3

SIDES = {
    "center": (0, 0, 0),
    "front": (1, 0, 0),
    "back": (-1, 0, 0),
    "left": (0, 1, 0),
    "right": (0, -1, 0),
    "top": (0, 0, 1),
    "bottom": (0, 0, -1),
}
"""Directions of the sides of an object, in its own frame."""


def point(end: End, plan: Plan, scene: Scene) -> Vec3:
    """Where an end is fastened, metres, world frame.

    A side is a side of the object itself, turned with it: about its own x by `deg_x`, then about z by its yaw, which is
    the order of `worldkit.bodies` (the shape is tilted inside its body, the body is yawed). Sizes are before the tilt.
    """
    if end.body == "world":
        return end.offset
    placed = scene[end.body]
    row = next((row for row in plan.scene_objects if row.name == end.body), None)
    size, tilt_deg = (placed.size, 0.0) if row is None else (row.size, row.deg_x)
    away = row.tilt_shift if row is not None else (0.0, 0.0, 0.0)
    x, y, z = (side * extent / 2 + more for side, extent, more in zip(SIDES[end.at], size, end.offset, strict=True))
    y, z = _turned(y, z, tilt_deg)
    x, y, z = x + away[0], y + away[1], z + away[2]
    x, y = _turned(x, y, placed.deg_z)
    cx, cy, cz = (float(c) for c in placed.position)
    return (round(cx + x, 9) + 0.0, round(cy + y, 9) + 0.0, round(cz + z, 9) + 0.0)


def _turned(a: float, b: float, deg: float) -> tuple[float, float]:
    """A point of a plane, counter-clockwise by `deg` degrees."""
    c, s = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return a * c - b * s, a * s + b * c
