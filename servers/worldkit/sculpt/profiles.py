"""Shapes from drawn outlines: a profile turned about z, an outline pulled up along z.

An outline is a closed row of points (N, 2), m; with `smooth` they are joined by a Catmull-Rom curve instead of straight lines.
"""

from collections.abc import Sequence

import numpy as np

from .signatures import signature
from .signed import Array, Shape

Outline = Sequence[Sequence[float]]
STEPS = 6
"""Straight pieces of a smooth curve between two of its points."""


def revolved(profile: Outline, smooth: bool = False, rounded: float = 0.0) -> Shape:
    """A profile of (radius, height) turned about z: a vase, a bottle, a bell, a chess piece.

    The profile runs from bottom to top and is closed along the axis; radii are not negative. `smooth` makes its points those
    of one flowing curve; `rounded` rounds its edges with a radius, m.
    """
    points = np.asarray(profile, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 2 or (points[:, 0] < 0).any():
        raise ValueError(
            "revolved: the profile is a row of (radius, height), with two or more points, no radius negative"
        )
    if smooth:
        points = curve(points)
        points[:, 0] = np.maximum(points[:, 0], 0.0)
    half = np.concatenate([points[:1] * (0.0, 1.0), points, points[-1:] * (0.0, 1.0)])
    # Its mirror image closes it, so that the axis is no edge of it.
    closed = np.concatenate([half, half[::-1] * (-1.0, 1.0)])
    flat = _outline(closed, rounded)
    r, low, high = points[:, 0].max(), points[:, 1].min(), points[:, 1].max()
    recipe = signature("revolved", points, rounded)
    return Shape(
        lambda p: flat(np.stack([np.hypot(p[:, 0], p[:, 1]), p[:, 2]], axis=1)),
        np.array([-r, -r, low]), np.array([r, r, high]), recipe,
    )  # fmt: skip


def extruded(outline: Outline, height: float, smooth: bool = False, rounded: float = 0.0) -> Shape:
    """An outline of (x, y) pulled up to a height, half of it to each side of z = 0: a letter, a gear, a leaf, a fin.

    `rounded` rounds all its edges with a radius, m, inside the outline.
    """
    points = np.asarray(outline, dtype=float)
    if points.ndim != 2 or points.shape[1] != 2 or len(points) < 3:
        raise ValueError("extruded: the outline is a closed row of three or more (x, y)")
    if not height > 0 or not 0 <= rounded <= height / 2:
        raise ValueError(
            f"extruded: height {height} m, rounded {rounded} m: the height is positive, and at least twice"
        )
    if smooth:
        points = curve(points, closed=True)
    flat, h = _outline(points, rounded), height / 2

    def measure(p: Array) -> Array:
        d, z = flat(p[:, :2]) + rounded, np.abs(p[:, 2]) - h + rounded
        return np.hypot(np.maximum(d, 0.0), np.maximum(z, 0.0)) + np.minimum(np.maximum(d, z), 0.0) - rounded

    low, high = points.min(axis=0), points.max(axis=0)
    recipe = signature("extruded", points, height, rounded)
    return Shape(measure, np.array([*low, -h]), np.array([*high, h]), recipe)


def _outline(points: Array, rounded: float):
    """Signed distance (N,) to a closed outline, its corners rounded inside it; source: I. Quilez, "Polygon, exact"."""
    starts, ends = points, np.roll(points, -1, axis=0)
    keep = np.linalg.norm(ends - starts, axis=1) > 1e-12
    starts, ends = starts[keep], ends[keep]

    def sharp(p: Array) -> Array:
        nearest = np.full(len(p), np.inf)
        inside = np.zeros(len(p), dtype=bool)
        for a, b in zip(starts, ends, strict=True):
            e = b - a
            wx, wy = p[:, 0] - a[0], p[:, 1] - a[1]
            along = np.clip((wx * e[0] + wy * e[1]) / (e @ e), 0.0, 1.0)
            np.minimum(nearest, (wx - e[0] * along) ** 2 + (wy - e[1] * along) ** 2, out=nearest)
            if e[1] != 0:
                crosses = (p[:, 1] >= a[1]) != (p[:, 1] >= b[1])
                inside ^= crosses & (wx < e[0] * wy / e[1])
        d = np.sqrt(nearest)
        return np.where(inside, -d, d)

    if not rounded:
        return sharp
    inner = inset(points, rounded)
    shrunk = _outline(inner, 0.0)
    return lambda p: shrunk(p) - rounded


def inset(points: Array, by: float) -> Array:
    """An outline (N, 2) moved inwards by so many metres; raises ValueError if nothing is left."""
    import manifold3d

    section = manifold3d.CrossSection([points], manifold3d.FillRule.NonZero).offset(-by, manifold3d.JoinType.Miter)
    if section.is_empty() or section.num_contour() > 1:
        raise ValueError(f"edges cannot be rounded by {by} m: the outline is thinner than twice that somewhere")
    return np.asarray(section.to_polygons()[0], dtype=float)


def curve(points: Outline | Array, closed: bool = False, steps: int = STEPS) -> Array:
    """The Catmull-Rom curve through points (N, D), `steps` straight pieces between two of them.

    Source: E. Catmull, R. Rom, "A class of local interpolating splines" (1974).
    """
    points = np.asarray(points, dtype=float)
    count = len(points)
    if closed:
        around = np.concatenate([points[-1:], points, points[:2]])
    else:
        around = np.concatenate([2 * points[:1] - points[1:2], points, 2 * points[-1:] - points[-2:-1]])
    t = np.arange(steps)[:, None] / steps
    found = []
    for k in range(count if closed else count - 1):
        p0, p1, p2, p3 = around[k : k + 4]
        found.append(
            0.5 * (2 * p1 + (p2 - p0) * t + (2 * p0 - 5 * p1 + 4 * p2 - p3) * t**2 + (3 * p1 - p0 - 3 * p2 + p3) * t**3)
        )
    return np.concatenate(found if closed else [*found, points[-1:]])
