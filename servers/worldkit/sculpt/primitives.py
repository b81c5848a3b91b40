"""The shapes that sculpting begins with. Full extents and diameters in metres, centred on the origin, z up, as in plans."""

import numpy as np

from .signatures import signature
from .signed import Array, Shape, Vec3


def sphere(diameter: float) -> Shape:
    """A ball."""
    _positive("sphere", diameter)
    r = diameter / 2
    return Shape(lambda p: _length(p) - r, np.full(3, -r), np.full(3, r), signature("sphere", r))


def ellipsoid(size: Vec3) -> Shape:
    """An ellipsoid of full extents `size` (about the distance)."""
    _positive("ellipsoid", *size)
    half = np.asarray(size, dtype=float) / 2

    def measure(p: Array) -> Array:
        scaled = p / half
        k0, k1 = _length(scaled), _length(scaled / half)
        return np.where(k1 > 1e-12, k0 * (k0 - 1.0) / np.maximum(k1, 1e-12), -half.min())

    return Shape(measure, -half, half, signature("ellipsoid", half))


def box(size: Vec3, rounded: float = 0.0) -> Shape:
    """A box of full extents `size`, its edges rounded with a radius."""
    _positive("box", *size)
    half = np.asarray(size, dtype=float) / 2
    if not 0 <= rounded <= half.min():
        raise ValueError(f"box: edges cannot be rounded by {rounded} m: its smallest side is {2 * half.min():g} m")

    def measure(p: Array) -> Array:
        q = np.abs(p) - (half - rounded)
        return _length(np.maximum(q, 0.0)) + np.minimum(q.max(axis=1), 0.0) - rounded

    return Shape(measure, -half, half, signature("box", half, rounded))


def cylinder(diameter: float, height: float, rounded: float = 0.0) -> Shape:
    """An upright cylinder, its rims rounded with a radius."""
    _positive("cylinder", diameter, height)
    r, h = diameter / 2, height / 2
    if not 0 <= rounded <= min(r, h):
        raise ValueError(f"cylinder: its rims cannot be rounded by {rounded} m")

    def measure(p: Array) -> Array:
        out = np.stack([np.hypot(p[:, 0], p[:, 1]) - r + rounded, np.abs(p[:, 2]) - h + rounded], axis=1)
        return _length(np.maximum(out, 0.0)) + np.minimum(out.max(axis=1), 0.0) - rounded

    half = np.array([r, r, h])
    return Shape(measure, -half, half, signature("cylinder", r, h, rounded))


def torus(diameter: float, thickness: float) -> Shape:
    """A ring lying flat: its outer diameter, and the diameter of its tube."""
    _positive("torus", diameter, thickness)
    if 2 * thickness > diameter:
        raise ValueError(f"torus: a tube of {thickness} m leaves no hole in a ring of {diameter} m")
    big, small = (diameter - thickness) / 2, thickness / 2
    half = np.array([diameter / 2, diameter / 2, small])
    recipe = signature("torus", big, small)
    return Shape(lambda p: np.hypot(np.hypot(p[:, 0], p[:, 1]) - big, p[:, 2]) - small, -half, half, recipe)


def capsule(start: Vec3, end: Vec3, diameter: float) -> Shape:
    """A rod with half balls beyond its ends: from point to point."""
    return round_cone(start, end, diameter, diameter)


def round_cone(start: Vec3, end: Vec3, diameter_start: float, diameter_end: float) -> Shape:
    """Two balls and what is stretched between them: a limb, a finger, a snout, a drop.

    Source: I. Quilez, "Round cone", between two points.
    """
    _positive("round_cone", diameter_start, diameter_end)
    a, b = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    r1, r2 = diameter_start / 2, diameter_end / 2
    axis = b - a
    length2 = float(axis @ axis)
    rr = r1 - r2
    recipe = signature("round_cone", a, b, r1, r2)
    low, high = np.minimum(a - r1, b - r2), np.maximum(a + r1, b + r2)
    if length2 <= rr * rr:  # one ball holds the other
        centre, r = (a, r1) if r1 >= r2 else (b, r2)
        return Shape(lambda p: _length(p - centre) - r, low, high, recipe)
    a2 = length2 - rr * rr

    def measure(p: Array) -> Array:
        pa = p - a
        y = pa @ axis
        z = y - length2
        crossed = pa * length2 - y[:, None] * axis
        x2 = np.einsum("ij,ij->i", crossed, crossed)
        y2, z2 = y * y * length2, z * z * length2
        k = np.sign(rr) * rr * rr * x2
        at_end = np.sqrt(x2 + z2) / length2 - r2
        at_start = np.sqrt(x2 + y2) / length2 - r1
        between = (np.sqrt(x2 * a2 / length2) + y * rr) / length2 - r1
        return np.where(np.sign(z) * a2 * z2 > k, at_end, np.where(np.sign(y) * a2 * y2 < k, at_start, between))

    return Shape(measure, low, high, recipe)


def half_space(normal: Vec3, offset: float = 0.0, reach: float = 10.0) -> Shape:
    """All on the far side of a plane, to cut with: points with `normal` . p < offset; its box reaches so many metres."""
    n = np.asarray(normal, dtype=float)
    length = float(np.linalg.norm(n))
    if not length > 0:
        raise ValueError("half_space: the normal has no direction")
    n = n / length
    return Shape(
        lambda p: p @ n - offset, np.full(3, -reach), np.full(3, reach), signature("half_space", n, offset, reach)
    )


def _length(vectors: Array) -> Array:
    return np.sqrt(np.einsum("ij,ij->i", vectors, vectors))


def _positive(what: str, *numbers: float) -> None:
    for number in numbers:
        if not 0 < number < np.inf:
            raise ValueError(f"{what}: sizes must be positive metres, got {number}")
