"""Convex collision pieces: exact primitives, sectors of a surface of revolution, and CoACD for everything else.

All poses are in the asset's build frame (metres, z up); `package` moves them to the AABB centre.
"""

from dataclasses import dataclass, field

import numpy as np

from .shapes import hull
from .surface import Surface

Vec3 = tuple[float, float, float]


@dataclass(frozen=True)
class Primitive:
    """An exact shape: `sphere` (diameter), `box` (extents), `cylinder` or `capsule` (diameter, height along its z)."""

    type: str
    pos: Vec3
    quat: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    extents: Vec3 | None = None
    diameter: float | None = None
    height: float | None = None
    contact: dict[str, float] = field(default_factory=dict)
    """Friction, restitution… where this piece differs from the whole asset."""
    name: str | None = None


@dataclass(frozen=True)
class Hull:
    """A convex piece given by its surface, then turned by `quat` and moved to `pos`; pieces may share a surface."""

    surface: Surface
    pos: Vec3 = (0.0, 0.0, 0.0)
    quat: tuple[float, float, float, float] = (1.0, 0.0, 0.0, 0.0)
    contact: dict[str, float] = field(default_factory=dict)
    name: str | None = None


def box(
    extents: Vec3, pos: Vec3, *, yaw_deg: float = 0.0, tilt_deg: float = 0.0, name: str | None = None, **contact: float
) -> Primitive:
    """A box turned by `yaw_deg` about z, after `tilt_deg` about its own y."""
    y, t = np.radians(yaw_deg) / 2, np.radians(tilt_deg) / 2
    quat = (
        float(np.cos(y) * np.cos(t)),
        float(-np.sin(y) * np.sin(t)),
        float(np.cos(y) * np.sin(t)),
        float(np.sin(y) * np.cos(t)),
    )
    return Primitive("box", pos, quat, extents=extents, contact=contact, name=name)


def cylinder(
    diameter: float, low: float, high: float, *, x: float = 0.0, y: float = 0.0, name: str | None = None
) -> Primitive:
    """An upright cylinder between two heights."""
    return Primitive("cylinder", (x, y, (low + high) / 2), diameter=diameter, height=high - low, name=name)


def sphere(diameter: float, pos: Vec3 = (0.0, 0.0, 0.0)) -> Primitive:
    """A ball."""
    return Primitive("sphere", pos, diameter=diameter)


def wall(
    diameter: float, thickness: float, low: float, high: float, count: int, *, x: float = 0.0, y: float = 0.0
) -> list[Primitive]:
    """A straight tube wall of inner `diameter` as a ring of `count` boxes."""
    inner = diameter / 2
    half = (inner + thickness) * np.tan(np.pi / count)
    ring = []
    for k in range(count):
        angle = 2 * np.pi * (k + 0.5) / count
        at = inner + thickness / 2
        pos = (float(x + at * np.cos(angle)), float(y + at * np.sin(angle)), (low + high) / 2)
        ring.append(box((thickness, float(2 * half), high - low), pos, yaw_deg=float(np.degrees(angle))))
    return ring


def sectors(section: np.ndarray, count: int, *, x: float = 0.0, y: float = 0.0) -> list[Hull]:
    """A ring with the convex (radius, z) `section` (N, 2), cut into `count` convex sectors."""
    half = np.pi / count
    one = hull(np.array([(r * np.cos(a), r * np.sin(a), z) for r, z in section for a in (-half, half)]))
    turns = (np.arange(count) + 0.5) * half  # half of each piece's angle
    return [Hull(one, (x, y, 0.0), (float(np.cos(t)), 0.0, 0.0, float(np.sin(t)))) for t in turns]


def decomposed(surface: Surface, *, threshold: float = 0.05, limit: int = -1, seed: int = 7) -> list[Hull]:
    """CoACD's convex pieces of a watertight surface; `threshold` is its concavity bound, `limit` a piece count."""
    import coacd

    coacd.set_log_level("error")
    pieces = coacd.run_coacd(
        coacd.Mesh(surface.vertices, surface.faces),
        threshold=threshold,
        max_convex_hull=limit,
        preprocess_mode="off",
        max_ch_vertex=48,
        seed=seed,
    )
    return [Hull(hull(np.asarray(vertices))) for vertices, _ in pieces]
