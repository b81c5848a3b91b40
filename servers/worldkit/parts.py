"""One rigid body of several primitives: where each part lies, the box around them, and how the mass is shared.

    ladder = (
        Part("rail", "box", size=(0.06, 0.03, 2.0), offset=(-0.2, 0, 1.0), count=2, step=(0.4, 0, 0)),
        Part("rung", "cylinder", size=(0.03, 0.03, 0.4), offset=(0, 0, 0.25), deg_y=90, count=7, step=(0, 0, 0.25)),
    )
    whole = laid_out("ladder", ladder)
    whole.extents                                  # (0.46, 0.03, 2.0)
    bodies.compound(spec, "ladder", parts=ladder, mass=8.0, pos=(0, 0, 1.0))

Offsets are measured from any point of the object that is convenient, such as the middle of its base: the whole is
centred on the box around its parts, whose centre `pos` gives. Metres, kilograms, degrees; no simulator is imported.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

Vec3 = tuple[float, float, float]
Matrix = tuple[Vec3, Vec3, Vec3]
"""A rotation, row by row."""
ROUND = {"sphere": "[d, d, d]", "cylinder": "[d, d, height]", "capsule": "[d, d, height]"}
SHAPES = ("box", "sphere", "cylinder", "capsule", "ellipsoid", "container")
WATER = 1000.0
"""kg/m^3: MuJoCo's density where none is given."""


@dataclass(frozen=True)
class Part:
    """One primitive of a compound body, or `count` of them.

    name: what its geom is called behind the body's name and a slash; `name_1` … when there are several.
    shape: one of `SHAPES`; a container is an open box with walls of thickness `wall`.
    size: full extents along its own axes, m.
    offset: of its centre, m, in the object's frame.
    deg_x, deg_y, deg_z: turned about the object's axes through its own centre: first x, then y, then z.
    mass: kg, of each copy; None: its share of the body's, or its volume times the surface's density.
    look, surface: as in `worldkit.bodies`; None: the whole body's.
    visual_only: drawn, without mass and contact.
    count, step, turn_deg: copy k lies k steps further (m) and is turned about the object's z, through the point that
        offsets are measured from, by k times `turn_deg`.
    """

    name: str
    shape: str
    size: Vec3
    offset: Vec3 = (0.0, 0.0, 0.0)
    deg_x: float = 0.0
    deg_y: float = 0.0
    deg_z: float = 0.0
    wall: float | None = None
    mass: float | None = None
    look: str | None = None
    surface: dict[str, Any] | None = None
    visual_only: bool = False
    count: int = 1
    step: Vec3 = (0.0, 0.0, 0.0)
    turn_deg: float = 0.0


@dataclass(frozen=True)
class Solid:
    """One geom: `half` sizes as MuJoCo takes them, the pose of its centre in the body's frame, its volume in m^3."""

    name: str
    shape: str
    half: Vec3
    centre: Vec3
    rotation: Matrix
    part: Part
    share: float = 1.0
    """Its share of its part's volume: less than one for a slab of a container."""

    @property
    def volume(self) -> float:
        """Its volume, m^3."""
        x, y, z = self.half
        return {
            "box": 8 * x * y * z,
            "sphere": 4 / 3 * math.pi * x**3,
            "cylinder": 2 * math.pi * x**2 * y,
            "capsule": 2 * math.pi * x**2 * y + 4 / 3 * math.pi * x**3,
            "ellipsoid": 4 / 3 * math.pi * x * y * z,
        }[self.shape]

    @property
    def reach(self) -> Vec3:
        """Half extents of the box around it along the body's axes, m."""
        a, b, c = (self._reach(row) for row in self.rotation)
        return (a, b, c)

    def _reach(self, row: Vec3) -> float:
        """How far it reaches, m, along an axis of the body that is given in the solid's own frame."""
        x, y, z = self.half
        along = abs(row[2])
        if self.shape == "box":
            return abs(row[0]) * x + abs(row[1]) * y + along * z
        if self.shape == "cylinder":
            return y * along + x * math.sqrt(max(1 - along**2, 0.0))
        if self.shape == "capsule":
            return y * along + x
        return x if self.shape == "sphere" else math.hypot(row[0] * x, row[1] * y, row[2] * z)


@dataclass(frozen=True)
class Whole:
    """The solids of a compound body in its frame, whose origin is the centre of the box around them."""

    solids: tuple[Solid, ...]
    extents: Vec3
    """Full extents of the box, after the tilt, m."""
    shift: Vec3 = field(repr=False)
    """Where the point that offsets are measured from lies, in the body's frame, m."""

    def masses(self, total: float | None = None, density: float | None = None) -> list[float]:
        """Kilograms of each solid.

        A part's own mass counts first. What is left of `total` is shared by the others in proportion to their volumes, or
        to volume times density if all of them have one. Without `total` they weigh volume times density. Where parts
        overlap, both count.

        Args:
            total: kg of the whole body.
            density: kg/m^3 of parts whose surface has none (MuJoCo's is 1000).

        Raises:
            ValueError: some parts weigh as much as `total`, or all have a mass and their sum is another.
        """
        own = [0.0 if s.part.visual_only else s.part.mass for s in self.solids]
        dense = [(s.part.surface or {}).get("density", density) for s in self.solids]
        sharing = [i for i, mass in enumerate(own) if mass is None]
        fixed = sum(mass * s.share for mass, s in zip(own, self.solids, strict=True) if mass is not None)
        unit = 1.0
        if total is None:
            dense = [WATER if d is None else d for d in dense]
        elif not sharing and not math.isclose(fixed, total, rel_tol=1e-6):
            raise ValueError(f"its parts weigh {fixed:.9g} kg together, not {total:g} kg")
        elif sharing and fixed >= total:
            raise ValueError(f"some parts weigh {fixed:.9g} kg, which leaves nothing of {total:g} kg for the others")
        elif not all(dense[i] for i in sharing):
            dense = [1.0] * len(dense)
        weights = [s.volume * (d or 0.0) for s, d in zip(self.solids, dense, strict=True)]
        if total is not None and sharing:
            unit = (total - fixed) / sum(weights[i] for i in sharing)
        # A container is several solids: its mass is shared by volume too.
        return [
            w * unit if mass is None else mass * s.share for w, mass, s in zip(weights, own, self.solids, strict=True)
        ]

    def centre_of_mass(self, masses: Sequence[float]) -> Vec3:
        """In the body's frame, from the centre of its box, m; the centre itself when nothing weighs."""
        total = sum(masses)
        if not total:
            return (0.0, 0.0, 0.0)
        x, y, z = (
            sum(mass * solid.centre[axis] for mass, solid in zip(masses, self.solids, strict=True)) / total
            for axis in range(3)
        )
        return (x, y, z)


def laid_out(name: str, parts: Sequence[Part], tilt_deg: float = 0.0) -> Whole:
    """The solids of a body called `name`, turned about its x by `tilt_deg` and centred on the box around them.

    Raises:
        ValueError: no parts, two with one name, a shape that is not known, a size that the shape cannot have.
    """
    if not parts:
        raise ValueError(f"compound {name}: it needs at least one part")
    tilt = rotation(deg_x=tilt_deg)
    found: list[Solid] = []
    for part in parts:
        local = rotation(part.deg_x, part.deg_y, part.deg_z)
        if part.count < 1 or (part.count > 1 and not any(part.step) and not part.turn_deg):
            raise ValueError(f"part {name}/{part.name}: {part.count} copies need a `step` or a turn apart")
        for k in range(part.count):
            turn = product(tilt, rotation(deg_z=k * part.turn_deg))
            label = part.name if part.count == 1 else f"{part.name}_{k + 1}"
            x, y, z = part.step
            middle = plus(turned(turn, part.offset), turned(tilt, (k * x, k * y, k * z)))
            pose = product(turn, local)
            copy = [
                Solid(f"{name}/{label}{piece}", shape, half, plus(middle, turned(pose, own)), pose, part)
                for piece, shape, own, half in pieces(f"{name}/{label}", part)
            ]
            volume = sum(solid.volume for solid in copy)
            found += [replace(solid, share=solid.volume / volume) for solid in copy]
    names = [solid.name for solid in found]
    if twice := sorted({n for n in names if names.count(n) > 1}):
        raise ValueError(f"compound {name}: two parts are called {', '.join(twice)}; give each a name of its own")
    low = [min(s.centre[i] - s.reach[i] for s in found) for i in range(3)]
    high = [max(s.centre[i] + s.reach[i] for s in found) for i in range(3)]
    x, y, z = (round(b - a, 9) for a, b in zip(low, high, strict=True))
    shift = (-(low[0] + high[0]) / 2, -(low[1] + high[1]) / 2, -(low[2] + high[2]) / 2)
    return Whole(tuple(replace(s, centre=plus(s.centre, shift)) for s in found), (x, y, z), shift)


def rotation(deg_x: float = 0.0, deg_y: float = 0.0, deg_z: float = 0.0) -> Matrix:
    """The rotation about x, then y, then z, with axes that stay where they are; exact at quarter turns."""
    (cx, sx), (cy, sy), (cz, sz) = (_cos_sin(deg) for deg in (deg_x, deg_y, deg_z))
    about_x = ((1.0, 0.0, 0.0), (0.0, cx, -sx), (0.0, sx, cx))
    about_y = ((cy, 0.0, sy), (0.0, 1.0, 0.0), (-sy, 0.0, cy))
    about_z = ((cz, -sz, 0.0), (sz, cz, 0.0), (0.0, 0.0, 1.0))
    return product(about_z, product(about_y, about_x))


def product(first: Matrix, second: Matrix) -> Matrix:
    """The product of two rotations: the second is applied first."""
    columns = [turned(first, (row[0], row[1], row[2])) for row in zip(*second, strict=True)]
    a, b, c = zip(*columns, strict=True)
    return (a, b, c)


def turned(matrix: Matrix, v: Vec3) -> Vec3:
    """A vector after a rotation."""
    x, y, z = (row[0] * v[0] + row[1] * v[1] + row[2] * v[2] for row in matrix)
    return (x, y, z)


def plus(a: Vec3, b: Vec3) -> Vec3:
    """The sum of two vectors."""
    return (a[0] + b[0], a[1] + b[1], a[2] + b[2])


def _cos_sin(deg: float) -> tuple[float, float]:
    quarters = deg / 90
    if quarters == round(quarters):
        return [(1.0, 0.0), (0.0, 1.0), (-1.0, 0.0), (0.0, -1.0)][round(quarters) % 4]
    return math.cos(math.radians(deg)), math.sin(math.radians(deg))


def pieces(label: str, part: Part) -> list[tuple[str, str, Vec3, Vec3]]:
    """The geoms of one part: suffix of the name, shape, centre in the part's frame, MuJoCo's half sizes.

    Raises:
        ValueError: a shape that is not known, or a size that it cannot have.
    """
    x, y, z = (extent / 2 for extent in part.size)
    if part.shape not in SHAPES:
        raise ValueError(f"part {label}: there is no shape {part.shape!r}; known: {', '.join(SHAPES)}")
    if not all(0 < extent < math.inf for extent in part.size):
        raise ValueError(f"part {label}: every extent must be a positive number of metres, got {part.size}")
    if part.shape in ROUND and (x != y or (part.shape == "sphere" and x != z)):
        raise ValueError(f"part {label}: a {part.shape} is round: write {ROUND[part.shape]}, got {part.size}")
    if part.shape == "capsule" and z < x:
        raise ValueError(
            f"part {label}: the height of a capsule includes both caps, so it cannot be under its diameter"
        )
    if part.shape == "container":
        slabs = slabs_of(label, part.size, part.wall or 0.0)
        return [(f"_{side}", "box", middle, half) for side, (middle, half) in slabs.items()]
    half: dict[str, Vec3] = {"sphere": (x, 0.0, 0.0), "cylinder": (x, z, 0.0), "capsule": (x, z - x, 0.0)}
    return [("", part.shape, (0.0, 0.0, 0.0), half.get(part.shape, (x, y, z)))]


def slabs_of(name: str, size: Vec3, wall: float) -> dict[str, tuple[Vec3, Vec3]]:
    """Floor and walls of an open box: centre and half sizes of each, m, in the box's own frame."""
    x, y, z = (extent / 2 for extent in size)
    t = wall / 2
    if not 0 < wall < min(x, y, 2 * z):
        raise ValueError(f"container {name}: walls of {wall} m do not fit into {size} m")
    return {
        "floor": ((0, 0, t - z), (x, y, t)),
        "front": ((x - t, 0, t), (t, y, z - t)),
        "back": ((t - x, 0, t), (t, y, z - t)),
        "left": ((0, y - t, t), (x - wall, t, z - t)),
        "right": ((0, t - y, t), (x - wall, t, z - t)),
    }
