"""Where to put things: in rows along a curve, at the skin of a shape; and how far along a curve points lie, for paint.

for place in sculpt.along(SPINE, 30):  # thirty spines on a back
    back = back.blend(spine.translate(*sculpt.skin(BACK, place.pos, place.pos + (0, 0, 1))), radius=0.002)
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from .profiles import curve
from .signed import Array, Shape, Vec3

FINE = 400
HALVINGS = 40


class Place(NamedTuple):
    """One place on a curve."""

    pos: Array
    """(3,) m."""
    forward: Array
    """(3,) unit vector along the curve."""
    share: float
    """Of the whole length, 0 to 1."""


def along(
    points: Sequence[Vec3], count: int, *, start: float = 0.0, end: float = 1.0, smooth: bool = True
) -> tuple[Place, ...]:
    """Places at equal distances along the curve through points, m, from a share of its length to another.

    The curve is the one that `tube` and `strap` follow with `smooth`.

    Raises:
        ValueError: fewer than two points, or shares outside 0 to 1.
    """
    if not (0 <= start <= 1 and 0 <= end <= 1) or count < 1:
        raise ValueError(f"along: {count} places from {start} to {end} of the length are none")
    line, way = _line(points, smooth)
    shares = np.linspace(start, end, count) if count > 1 else np.array([(start + end) / 2])
    found = np.stack([np.interp(shares * way[-1], way, line[:, k]) for k in range(3)], axis=1)
    pieces = np.clip(np.searchsorted(way, shares * way[-1], side="right") - 1, 0, len(line) - 2)
    forward = np.diff(line, axis=0)[pieces]
    forward /= np.linalg.norm(forward, axis=1)[:, None]
    return tuple(Place(p, f, float(s)) for p, f, s in zip(found, forward, shares, strict=True))


def share_along(points: Array, way: Sequence[Vec3], *, smooth: bool = True) -> Array:
    """How far along a curve (0 to 1) the nearest place on it lies, (N,), for points (N, 3): paint down an arm or a tail."""
    line, length = _line(way, smooth)
    line, length = line[:: max(len(line) // FINE, 1)], length[:: max(len(length) // FINE, 1)]
    best, found = np.full(len(points), np.inf), np.zeros(len(points))
    for here, there, begun, ended in zip(line, line[1:], length, length[1:], strict=False):
        edge = there - here
        t = np.clip((points - here) @ edge / max(edge @ edge, 1e-18), 0, 1)
        away = ((points - here - t[:, None] * edge) ** 2).sum(axis=1)
        nearer = away < best
        best[nearer], found[nearer] = away[nearer], (begun + t * (ended - begun))[nearer]
    return found / length[-1]


def skin(shape: Shape, inside: Sequence[float], towards: Sequence[float]) -> Vec3:
    """Where the way from a point inside a shape towards another point leaves it for the last time, m.

    Raises:
        ValueError: that way does not meet the shape.
    """
    begun, aim = np.asarray(inside, dtype=float), np.asarray(towards, dtype=float)
    reach = float(np.linalg.norm(aim - begun))
    if reach == 0:
        raise ValueError("skin: both points are the same")
    far = float(np.linalg.norm(shape.size)) + float(np.linalg.norm(begun - shape.centre))
    t = np.linspace(0.0, far, FINE)
    ray = begun + t[:, None] * (aim - begun) / reach
    within = np.flatnonzero(shape(ray) < 0)
    if not len(within):
        raise ValueError(f"skin: from {tuple(begun)} towards {tuple(aim)} there is nothing of the shape")
    low, high = t[within[-1]], t[min(within[-1] + 1, FINE - 1)]
    for _ in range(HALVINGS):
        middle = (low + high) / 2
        if shape((begun + middle * (aim - begun) / reach)[None])[0] < 0:
            low = middle
        else:
            high = middle
    x, y, z = (begun + low * (aim - begun) / reach).tolist()
    return x, y, z


def _line(points: Sequence[Vec3], smooth: bool) -> tuple[Array, Array]:
    """The curve in fine pieces (M, 3), m, and the length up to each corner (M,), m."""
    corners = np.asarray(points, dtype=float).reshape(-1, 3)
    if len(corners) < 2:
        raise ValueError("a curve needs two points at least")
    line = curve(corners, steps=24) if smooth and len(corners) > 2 else corners
    return line, np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(line, axis=0), axis=1))])
