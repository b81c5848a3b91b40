"""Tubes along curves: limbs, tails, handles, horns, roots, and flat straps."""

import itertools
from collections.abc import Sequence

import numpy as np

from .profiles import STEPS, curve
from .signatures import signature
from .signed import Array, Shape, Vec3, boxed


def tube(points: Sequence[Vec3], diameters: float | Sequence[float], smooth: bool = True, steps: int = STEPS) -> Shape:
    """A round tube through points, m, with its diameter at each of them, closed by half balls.

    With `smooth` the points and diameters are those of one flowing curve (Catmull-Rom), else of a bent rod.
    """
    path = np.asarray(points, dtype=float)
    if path.ndim != 2 or path.shape[1] != 3 or len(path) < 2:
        raise ValueError("tube: give two or more points (x, y, z)")
    thick = np.broadcast_to(np.asarray(diameters, dtype=float), (len(path),))
    if not (thick > 0).all():
        raise ValueError("tube: diameters must be positive")
    whole = np.column_stack([path, thick / 2])
    if smooth and len(path) > 2:
        whole = curve(whole, steps=steps)
        whole[:, 3] = np.maximum(whole[:, 3], 0.2 * thick.min() / 2)
    low, high = boxed(np.concatenate([whole[:, :3] - whole[:, 3:], whole[:, :3] + whole[:, 3:]]))

    def measure(p: Array) -> Array:
        found = np.full(len(p), np.inf)
        for a, b in itertools.pairwise(whole):
            _, away, radius = _along(p, a, b)
            np.minimum(found, np.sqrt(away) - radius, out=found)
        return found

    return Shape(measure, low, high, signature("tube", whole))


def strap(points: Sequence[Vec3], width: float, thickness: float, facing: Vec3, smooth: bool = True) -> Shape:
    """A flat band along a curve: a strap, a belt, a ribbon, a scarf, a blade.

    `facing` is where its flat side looks: away from what it lies on, at least roughly; edges are rounded.
    """
    path, out = np.asarray(points, dtype=float), np.asarray(facing, dtype=float)
    if path.ndim != 2 or path.shape[1] != 3 or len(path) < 2:
        raise ValueError("strap: give two or more points (x, y, z)")
    if not 0 < thickness <= width:
        raise ValueError(f"strap: 0 < thickness <= width, not {thickness} and {width} m")
    line = curve(path) if smooth and len(path) > 2 else path
    frames = []
    for a, b in itertools.pairwise(line):
        side = np.cross(b - a, out)
        if not np.linalg.norm(side) > 1e-9:
            raise ValueError("strap: it runs along `facing` somewhere; name the side that it shows")
        side /= np.linalg.norm(side)
        up = np.cross(side, b - a)
        frames.append((side, up / np.linalg.norm(up)))
    half, r = width / 2 - thickness / 2, thickness / 2

    def measure(p: Array) -> Array:
        found = np.full(len(p), np.inf)
        for a, b, (side, up) in zip(line[:-1], line[1:], frames, strict=True):
            t, _, _ = _along(p, np.append(a, 0.0), np.append(b, 0.0))
            q = p - (a + t[:, None] * (b - a))
            across, above = q @ side, q @ up
            rest = np.maximum(np.einsum("ij,ij->i", q, q) - across**2 - above**2, 0.0)
            across = np.maximum(np.abs(across) - half, 0.0)
            np.minimum(found, np.sqrt(across**2 + above**2 + rest) - r, out=found)
        return found

    reach = width / 2 + r
    low, high = boxed(np.concatenate([line - reach, line + reach]))
    return Shape(measure, low, high, signature("strap", line, width, thickness, out))


def _along(p: Array, a: Array, b: Array) -> tuple[Array, Array, Array]:
    """Share of the way (N,) from a to b nearest to points, squared distance (N,) there, radius (N,) there; a, b (4,)."""
    way = b[:3] - a[:3]
    w = p - a[:3]
    t = np.clip((w @ way) / max(float(way @ way), 1e-18), 0.0, 1.0)
    dx, dy, dz = (w[:, k] - t * way[k] for k in range(3))
    return t, dx * dx + dy * dy + dz * dz, a[3] + t * (b[3] - a[3])
