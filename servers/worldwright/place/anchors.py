"""A yawed box and its anchors, which predicates read and set.

World frame: z up, +X front, +Y left, metres; yaw in degrees counter-clockwise from +X. `half_x` and `half_y` are half
extents of the *world* AABB, so a box yawed by 90 degrees has its own y extent along world x:

    half_x = (size_x |cos yaw| + size_y |sin yaw|) / 2        half_y = (size_x |sin yaw| + size_y |cos yaw|) / 2

Round things (spheres, upright cylinders) keep their extents at any yaw. Source: paper, Predicate-to-Position Contract.
"""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

Vec3 = tuple[float, float, float]
DOFS = ("x", "y", "z", "yaw")
TOLERANCE_M = 1e-3
"""A layout may differ by so much from what a row says."""
TOLERANCE_DEG = 0.5


@dataclass(frozen=True)
class Surface:
    """A surface of an object, in its own frame, on which things rest.

    height_m: above the object's lowest point. centre, extents: of the free area, m, relative to the box's centre (x, y).
    """

    name: str
    height_m: float
    extents: tuple[float, float]
    centre: tuple[float, float] = (0.0, 0.0)
    shape: str = "rectangle"

    def inset(self, x: float, y: float) -> float:
        """Distance of a point (own frame, from the box's centre) to the area's edge; negative outside, metres."""
        dx, dy = x - self.centre[0], y - self.centre[1]
        rx, ry = self.extents[0] / 2, self.extents[1] / 2
        if self.shape == "ellipse" and math.isfinite(rx):
            radius = math.hypot(dx / rx, dy / ry)
            return (1 - radius) * min(rx, ry)
        outside = math.hypot(max(abs(dx) - rx, 0), max(abs(dy) - ry, 0))
        return -outside if outside else min(rx - abs(dx), ry - abs(dy))


class UnplacedError(Exception):
    """An anchor was read before it was set; the engine orders rows so that this cannot happen."""


class CannotResolveError(Exception):
    """The numbers of a row have no solution; it tells the cause and the fix."""

    def __init__(self, cause: str, fix: str) -> None:
        super().__init__(cause)
        self.fix = fix


def no_surface(name: str | None) -> Surface:
    """Refuse any surface, for an object on which nothing rests."""
    raise KeyError(f"no surface {name!r}")


@dataclass(slots=True)
class Box:
    """An object while it is placed: anchors that are not known yet are None."""

    name: str
    size: Vec3
    x: float | None = None
    y: float | None = None
    z: float | None = None
    yaw: float | None = None
    round: bool = False
    """Extents do not change with yaw."""
    surface: Callable[[str | None], Surface] = field(default=no_surface, repr=False)
    """Gives a named surface, or the default one; a KeyError lists the known ones."""
    surfaces: Callable[[], Sequence[Surface]] = field(default=tuple, repr=False)
    """Gives every named surface, the default one first."""
    floor_datum: bool = False
    """Plans give the height of its floor, not of its centre (containers that are a generated_boundary)."""

    @property
    def written_shift(self) -> float:
        """The shift from the centre's z to the one that plans write for this object, metres."""
        return -self.size[2] / 2 if self.floor_datum else 0.0

    def get(self, dof: str) -> float:
        """A coordinate that must be known by now."""
        value: float | None = getattr(self, dof)
        if value is None:
            raise UnplacedError(f"{self.name}.{dof}")
        return value

    def half(self, axis: str) -> float:
        """Half the extent of the world AABB along an axis, metres."""
        sx, sy, sz = self.size
        if axis == "z":
            return sz / 2
        if self.round or sx == sy == 0:
            return (sx if axis == "x" else sy) / 2
        yaw = self.get("yaw")
        if yaw % 180 == 0:  # exactly, so that square angles give exact numbers
            c, s = 1.0, 0.0
        elif yaw % 90 == 0:
            c, s = 0.0, 1.0
        else:
            c, s = abs(math.cos(math.radians(yaw))), abs(math.sin(math.radians(yaw)))
        return (sx * c + sy * s) / 2 if axis == "x" else (sx * s + sy * c) / 2

    def low(self, axis: str) -> float:
        """The lower face along an axis."""
        return self.get(axis) - self.half(axis)

    def high(self, axis: str) -> float:
        """The upper face along an axis."""
        return self.get(axis) + self.half(axis)

    def to_world(self, x: float, y: float) -> tuple[float, float]:
        """Turn a vector from the object's own plane into the world's."""
        c, s = cos_sin(self.get("yaw"))
        return (c * x - s * y, s * x + c * y)

    def spread(self, turned_deg: float) -> tuple[float, float]:
        """Half extents in the plane, m, along axes against which the object is turned by an angle."""
        if self.round:
            return (self.size[0] / 2, self.size[1] / 2)
        c, s = (abs(v) for v in cos_sin(turned_deg))
        return ((self.size[0] * c + self.size[1] * s) / 2, (self.size[0] * s + self.size[1] * c) / 2)

    def corners(self) -> list[tuple[float, float]]:
        """The four corners of its footprint, world frame, counter-clockwise."""
        x, y, (sx, sy, _) = self.get("x"), self.get("y"), self.size
        yaw = 0.0 if self.round else self.get("yaw")
        c, s = cos_sin(yaw)
        signs = ((1, 1), (-1, 1), (-1, -1), (1, -1))
        return [(x + (c * i * sx - s * j * sy) / 2, y + (s * i * sx + c * j * sy) / 2) for i, j in signs]

    def to_own(self, x: float, y: float) -> tuple[float, float]:
        """A world point as seen from the object's centre, along its own axes, m."""
        dx, dy = x - self.get("x"), y - self.get("y")
        c, s = cos_sin(self.get("yaw"))
        return (c * dx + s * dy, -s * dx + c * dy)


def cos_sin(degrees: float) -> tuple[float, float]:
    """Cosine and sine of an angle in degrees, exact at multiples of 90."""
    exact = {0: (1.0, 0.0), 90: (0.0, 1.0), 180: (-1.0, 0.0), 270: (0.0, -1.0)}
    turned = degrees % 360
    if turned in exact:
        return exact[int(turned)]
    return (math.cos(math.radians(degrees)), math.sin(math.radians(degrees)))


def wrap(degrees: float) -> float:
    """An angle in (-180, 180]."""
    turned = math.fmod(degrees, 360.0)
    if turned > 180:
        return turned - 360
    return turned + 360 if turned <= -180 else turned


@dataclass(frozen=True)
class Derivation:
    """One coordinate and the formula that gave it, with its numbers."""

    value: float
    formula: str


def total(dof: str, *terms: tuple[str, float]) -> Derivation:
    """A sum as a derivation: `total("y", ("table.max_y", 0.45), ("gap", 0.1))`; a leading `-` subtracts."""
    symbols, numbers, value = "", "", 0.0
    for index, (name, amount) in enumerate(terms):
        minus = name.startswith("-")
        sign = ("-" if index == 0 else " - ") if minus else ("" if index == 0 else " + ")
        symbols += sign + name.removeprefix("-")
        numbers += sign + (f"({shown(amount)})" if amount < 0 and (index or minus) else shown(amount))
        value += -amount if minus else amount
    if len(terms) == 1 and not terms[0][0].startswith("-"):
        return Derivation(value, f"{dof} = {symbols} = {shown(value)}")
    return Derivation(value, f"{dof} = {symbols} = {numbers} = {shown(value)}")


def shown(value: float) -> str:
    """A number as provenance shows it: to micrometres, without trailing zeros."""
    text = f"{round(value, 6) + 0.0:.6f}".rstrip("0").rstrip(".")
    return "0" if text in ("-0", "") else text
