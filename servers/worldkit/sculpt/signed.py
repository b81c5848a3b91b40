"""A shape as a signed distance function: metres to its surface, negative inside, with what can be done to one shape.

    body = ellipsoid((0.3, 0.2, 0.2)).blend(sphere(0.15).translate(0.14, 0, 0.1), radius=0.04)
    vase = revolved(profile).shell(0.004) - cylinder(0.2, 0.05).translate(0, 0, 0.15)

Where an operation says "about the distance", the value away from the surface is an estimate; the surface is exact.
Source: J. C. Hart, "Sphere tracing" (1996), and I. Quilez, "Distance functions".
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from .signatures import signature

Array = np.ndarray
Vec3 = tuple[float, float, float]
AXES = {"x": 0, "y": 1, "z": 2}


@dataclass(frozen=True, eq=False)
class Shape:
    """One solid: its distance function and the box that holds it.

    Points (N, 3) in metres give distances (N,) in metres. `low` and `high` (3,) are corners of a box around it.
    """

    measure: Callable[[Array], Array]
    low: Array
    high: Array
    recipe: str
    """Tells this shape from others; two of one recipe are the same."""

    def __call__(self, points: Array) -> Array:
        """Signed distances (N,) of points (N, 3), m."""
        return self.measure(np.asarray(points, dtype=float).reshape(-1, 3))

    def __or__(self, other: "Shape") -> "Shape":
        """Both: their union."""
        return union(self, other)

    def __and__(self, other: "Shape") -> "Shape":
        """What both share: their intersection."""
        return intersection(self, other)

    def __sub__(self, other: "Shape") -> "Shape":
        """This without the other: their difference."""
        return difference(self, other)

    def blend(self, other: "Shape", radius: float) -> "Shape":
        """Smooth union: flowing into each other over about `radius`, m."""
        return union(self, other, radius=radius)

    def carve(self, other: "Shape", radius: float = 0.0) -> "Shape":
        """Smooth difference: the other taken away, with edges rounded over about `radius`, m."""
        return difference(self, other, radius=radius)

    @property
    def size(self) -> Array:
        """(3,) extents of its box, m."""
        return self.high - self.low

    @property
    def centre(self) -> Array:
        """(3,) centre of its box, m."""
        return (self.low + self.high) / 2

    def translate(self, x: float = 0.0, y: float = 0.0, z: float = 0.0) -> "Shape":
        """Moved by so many metres."""
        away = np.array([x, y, z], dtype=float)
        recipe = signature("translate", self, away)
        return Shape(lambda p: self.measure(p - away), self.low + away, self.high + away, recipe)

    def rotate(self, deg: float, axis: str | Vec3 = "z", about: Vec3 = (0.0, 0.0, 0.0)) -> "Shape":
        """Turned counter-clockwise, seen against an axis ("x", "y", "z" or a vector) through the point `about`."""
        turn, pivot = rotation_about(deg, axis), np.array(about, dtype=float)
        low, high = boxed(pivot + (self.corners() - pivot) @ turn.T)
        return Shape(
            lambda p: self.measure((p - pivot) @ turn + pivot), low, high, signature("rotate", self, turn, pivot)
        )

    def scale(self, factor: float | Vec3, about: Vec3 = (0.0, 0.0, 0.0)) -> "Shape":
        """Enlarged about a point, alike or by a factor for each axis (then about the distance)."""
        factors, pivot = np.broadcast_to(np.asarray(factor, dtype=float), (3,)), np.array(about, dtype=float)
        if not (factors > 0).all():
            raise ValueError(f"scale: factors must be positive, got {factor}; mirror() turns a shape around")
        least = float(factors.min())
        low, high = pivot + (self.low - pivot) * factors, pivot + (self.high - pivot) * factors
        recipe = signature("scale", self, factors, pivot)
        return Shape(lambda p: self.measure((p - pivot) / factors + pivot) * least, low, high, recipe)

    def mirror(self, axis: str = "x", radius: float = 0.0) -> "Shape":
        """With its mirror image in the plane where that coordinate is 0, blended over `radius`, m, where they meet."""
        k = AXES[axis]
        flip = np.ones(3)
        flip[k] = -1.0
        low, high = np.minimum(self.low, self.low * flip), np.maximum(self.high, self.high * flip)
        low[k], high[k] = min(self.low[k], -self.high[k]), max(self.high[k], -self.low[k])
        recipe = signature("mirror", self, axis, radius)
        return Shape(
            lambda p: smallest(self.measure(p), self.measure(p * flip), radius),
            low - radius / 4,
            high + radius / 4,
            recipe,
        )

    def mirrored(self, axis: str = "x") -> "Shape":
        """Its mirror image alone."""
        flip = np.ones(3)
        flip[AXES[axis]] = -1.0
        low, high = boxed(np.stack([self.low, self.high]) * flip)
        return Shape(lambda p: self.measure(p * flip), low, high, signature("mirrored", self, axis))

    def grow(self, by: float) -> "Shape":
        """Its surface moved outwards by so many metres, which rounds its edges; inwards if negative."""
        recipe = signature("grow", self, by)
        return Shape(lambda p: self.measure(p) - by, self.low - by, self.high + by, recipe)

    def shell(self, thickness: float) -> "Shape":
        """Hollow, with a wall of this thickness, m, inside its surface; open it with a difference."""
        if not thickness > 0:
            raise ValueError(f"shell: the wall must be thicker than {thickness} m")

        def measure(p: Array) -> Array:
            d = self.measure(p)
            return np.maximum(d, -d - thickness)

        return Shape(measure, self.low, self.high, signature("shell", self, thickness))

    def corners(self) -> Array:
        """(8, 3) corners of its box, m."""
        return np.array([[(self.low, self.high)[i >> k & 1][k] for k in range(3)] for i in range(8)])


def boxed(points: Array) -> tuple[Array, Array]:
    """Lowest and highest corner (3,) of points (N, 3)."""
    return points.min(axis=0), points.max(axis=0)


def rotation_about(deg: float, axis: str | Sequence[float]) -> Array:
    """(3, 3) rotation about an axis by name or vector, counter-clockwise seen against it.

    Source: Rodrigues' formula.
    """
    if isinstance(axis, str):
        if axis not in AXES:
            raise ValueError(f"there is no axis {axis!r}: use x, y, z or a vector")
        vector = np.eye(3)[AXES[axis]]
    else:
        vector = np.asarray(axis, dtype=float)
    length = float(np.linalg.norm(vector))
    if not length > 0:
        raise ValueError("the axis has no direction")
    x, y, z = vector / length
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    angle = math.radians(deg)
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def smallest(a: Array, b: Array, radius: float) -> Array:
    """The smaller of two distances, rounded over `radius` where they are alike.

    Source: I. Quilez, "Smooth minimum", the quadratic polynomial.
    """
    if radius <= 0:
        return np.minimum(a, b)
    near = np.maximum(radius - np.abs(a - b), 0.0)
    return np.minimum(a, b) - near * near / (4 * radius)


def union(*shapes: Shape, radius: float = 0.0) -> Shape:
    """All of them as one; with a `radius`, m, they flow into each other over about that length (smooth union)."""
    _some("union", shapes)

    def measure(p: Array) -> Array:
        found = shapes[0].measure(p)
        for shape in shapes[1:]:
            found = smallest(found, shape.measure(p), radius)
        return found

    low = np.min([s.low for s in shapes], axis=0) - radius / 4
    high = np.max([s.high for s in shapes], axis=0) + radius / 4
    return shapes[0] if len(shapes) == 1 else Shape(measure, low, high, signature("union", *shapes, radius))


def intersection(*shapes: Shape, radius: float = 0.0) -> Shape:
    """What all of them share, with edges rounded over about `radius`, m."""
    _some("intersection", shapes)

    def measure(p: Array) -> Array:
        found = shapes[0].measure(p)
        for shape in shapes[1:]:
            found = -smallest(-found, -shape.measure(p), radius)
        return found

    low = np.max([s.low for s in shapes], axis=0)
    high = np.min([s.high for s in shapes], axis=0)
    if not (high > low).all():
        raise ValueError("intersection: the shapes do not meet")
    return Shape(measure, low, high, signature("intersection", *shapes, radius))


def difference(shape: Shape, *others: Shape, radius: float = 0.0) -> Shape:
    """The first without the others, with edges rounded over about `radius`, m."""
    _some("difference", others)

    def measure(p: Array) -> Array:
        found = shape.measure(p)
        for other in others:
            found = -smallest(-found, other.measure(p), radius)
        return found

    return Shape(measure, shape.low, shape.high, signature("difference", shape, *others, radius))


def _some(what: str, shapes: Sequence[Shape]) -> None:
    if not shapes or not all(isinstance(shape, Shape) for shape in shapes):
        raise ValueError(f"{what}: give shapes, e.g. {what}(sphere(0.1), box((0.1, 0.1, 0.1)))")
