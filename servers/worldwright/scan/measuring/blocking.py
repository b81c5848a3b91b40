"""What stands between a place and something: straight lines from the one to the other, against the shapes of bodies.

Shapes are those that the recording tells, posed as recorded: spheres, ellipsoids, capsules, cylinders and boxes exactly, all
others as their boxes, and none as clear. What reaches beyond the line's ends does not count, nor what is within `NEAR_M` of them,
so that a place may lie on a surface. Source: ray casting; the quadratic of a line and a sphere or cylinder, the slabs of a box.
"""

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from worldkit.turning import matrices

from ...model.recording.trajectory import Trajectory
from .measured import UnknowableError

Array = np.ndarray
NEAR_M = 1e-3
POINTS = 160
"""Places in a thing to which lines are drawn."""
EVERY_S = 1 / 60
"""Lines are drawn so often."""
CLEARLY = 0.1
"""A share that has come to a bound has left it when it is lower by so much."""


@dataclass(frozen=True)
class Solid:
    """One shape of a body."""

    kind: str
    """`sphere` (of ellipsoids, too), `cylinder`, or `box`."""
    half: Array
    """(3,) m: half its extents along its own axes."""
    pos: Array
    """(3,) m, in the body's frame."""
    turn: Array
    """(3, 3) its axes in the body's frame, as columns."""
    rough: bool = False
    """It stands for a shape that fills its box only in part: a mesh, a height field."""

    def inside(self, points: Array) -> Array:
        """(N,) bool, of points (N, 3) in its own frame."""
        unit = points / self.half
        if self.kind == "box":
            return np.asarray((np.abs(unit) <= 1).all(axis=1))
        flat = (unit[:, :2] ** 2).sum(axis=1)
        return np.asarray(
            (flat <= 1) & (np.abs(unit[:, 2]) <= 1) if self.kind == "cylinder" else flat + unit[:, 2] ** 2 <= 1
        )

    def meets(self, start: Array, way: Array) -> Array:
        """(…,) bool: whether the stretch from `start` (…, 3) over `way` (…, 3), both in its own frame, goes through it."""
        start, way = start / self.half, way / self.half
        low, high = np.zeros(start.shape[:-1]), np.ones(start.shape[:-1])
        across = {"box": (), "cylinder": (0, 1), "sphere": (0, 1, 2)}[self.kind]
        if across:
            a, b = (way[..., across] ** 2).sum(axis=-1), (way[..., across] * start[..., across]).sum(axis=-1)
            c = (start[..., across] ** 2).sum(axis=-1) - 1
            root = np.sqrt(np.maximum(b**2 - a * c, 0.0))
            far = np.maximum(a, 1e-12)
            misses = (b**2 < a * c) | ((a < 1e-12) & (c > 0))
            low = np.where(misses, 2.0, np.where(a < 1e-12, low, np.maximum(low, (-b - root) / far)))
            high = np.where(a < 1e-12, high, np.minimum(high, (-b + root) / far))
        for axis in {"box": (0, 1, 2), "cylinder": (2,), "sphere": ()}[self.kind]:
            rate = np.where(np.abs(way[..., axis]) < 1e-12, 1e-12, way[..., axis])
            ends = (-1 - start[..., axis]) / rate, (1 - start[..., axis]) / rate
            low, high = np.maximum(low, np.minimum(*ends)), np.minimum(high, np.maximum(*ends))
        return np.asarray(low <= high)


def solids(trajectory: Trajectory, body: int) -> list[Solid]:
    """The shapes of a body that are drawn; of all its shapes where none is, of its box where the recording tells no shape.

    Raises:
        UnknowableError: the recording does not tell its shape.
    """
    name = trajectory.names[body]
    rows = [row for row in trajectory.meta.get("geoms") or () if row.get("body") == name]
    rows = [row for row in rows if row.get("visible", True)] or rows
    found: list[Solid] = []
    for row in rows:
        kind, size = str(row.get("type", "")), np.array([*row.get("size", ()), 0.0, 0.0, 0.0], dtype=float)
        turn, pos = (
            matrices(np.array(row.get("quat", (1, 0, 0, 0)), dtype=float)),
            np.array(row.get("pos", (0, 0, 0)), float),
        )
        if kind in ("sphere", "ellipsoid"):
            found.append(Solid("sphere", size[[0, 0, 0] if kind == "sphere" else [0, 1, 2]], pos, turn))
        elif kind in ("cylinder", "capsule"):
            found.append(Solid("cylinder", size[[0, 0, 1]], pos, turn))
            if kind == "capsule":
                ends = (pos + sign * size[1] * turn[:, 2] for sign in (-1, 1))
                found += [Solid("sphere", size[[0, 0, 0]], end, turn) for end in ends]
        elif kind != "plane" and len(row.get("aabb", ())) == 6:
            middle, half = np.array(row["aabb"][:3], float), np.maximum(np.array(row["aabb"][3:], float), 1e-6)
            found.append(Solid("box", half, pos + turn @ middle, turn, rough=kind != "box"))
    facts = trajectory.mechanics
    half = None if facts.half_extents is None else facts.half_extents[body]
    if not found and half is not None and facts.center is not None and np.isfinite(half).all():
        found = [Solid("box", np.maximum(half, 1e-6), facts.center[body], np.eye(3))]
    if not found:
        raise UnknowableError(f"the recording does not tell the shape of {name}")
    return found


def points_of(trajectory: Trajectory, body: int) -> Array:
    """(N, 3) places evenly all through a body, in its own frame, m; about `POINTS`, the same each time."""
    shapes = solids(trajectory, body)
    bulk = np.array([shape.half.prod() for shape in shapes])
    found = []
    for shape, share in zip(shapes, bulk / max(bulk.sum(), 1e-30), strict=True):
        spread = _even(4 * max(int(POINTS * share), 4)) * shape.half
        inner = spread[shape.inside(spread)][: max(int(POINTS * share), 4)]
        found.append(inner @ shape.turn.T + shape.pos)
    return np.concatenate(found)


def ball(radius_m: float) -> Array:
    """(N, 3) places evenly all through a ball about the origin, m."""
    spread = _even(2 * POINTS)
    return np.asarray(spread[(spread**2).sum(axis=1) <= 1] * radius_m)


def _even(count: int) -> Array:
    """(N, 3) points that fill the cube from -1 to 1 evenly. Source: Roberts' additive recurrence of the plastic number."""
    ratio = 1.2207440846057596
    steps = np.array([1 / ratio, 1 / ratio**2, 1 / ratio**3])
    return np.asarray(2 * ((0.5 + np.arange(1, count + 1)[:, None] * steps) % 1.0) - 1)


def chosen(trajectory: Trajectory, rows: slice, *, last: bool = False) -> Array:
    """Numbers of some rows, the first and then one each `EVERY_S`; those of a longer recording hold those of its beginning.

    The `last` of all is added where it is asked for.
    """
    found = np.arange(rows.start, rows.stop, max(1, round(EVERY_S / max(trajectory.interval_s, 1e-9))))
    return np.append(found, rows.stop - 1) if last and found[-1] != rows.stop - 1 else found


def blocked(
    trajectory: Trajectory,
    rows: Array,
    eyes: Array,
    points: Array,
    bodies: Iterable[int],
    *,
    seen: Array | None = None,
    rough: bool = True,
) -> Array:
    """(R,) share of the lines from an eye to some points that go through one of these bodies.

    Args:
        trajectory: whose bodies they are.
        rows: (R,) numbers of its rows.
        eyes: (R, 3) in the world, m.
        points: (R, P, 3) in the world, m.
        bodies: indices of what may stand between.
        seen: (R, P) bool: the points that count, one at least of each row; all where it is not given.
        rough: shapes that are known as their boxes only stand between as well.
    """
    way = points - eyes[:, None]
    length = np.linalg.norm(way, axis=2, keepdims=True)
    inset = np.minimum(NEAR_M / np.maximum(length, 1e-12), 0.5)
    start, way = eyes[:, None] + inset * way, (1 - 2 * inset) * way
    hit = np.zeros(points.shape[:2], dtype=bool)
    for body in bodies:
        axes, place = matrices(trajectory.quat[rows, body]), trajectory.pos[rows, body]
        for shape in solids(trajectory, body):
            if shape.rough and not rough:
                continue
            turn = axes @ shape.turn
            middle = place + axes @ shape.pos
            hit |= shape.meets((start - middle[:, None]) @ turn, way @ turn)
    return np.asarray(hit.mean(axis=1) if seen is None else (hit & seen).sum(axis=1) / seen.sum(axis=1))


def times(values: Array, least: float) -> int:
    """How many stretches of values there are at or above `least`.

    A stretch ends where they fall clearly below, by `CLEARLY` or to half of it: what trembles at the edge comes once.
    """
    ends, count, inside = max(least - CLEARLY, least / 2), 0, False
    for value in values:
        count += not inside and value >= least
        inside = value >= (ends if inside else least)
    return int(count)


def sure(boxed: float, bare: float, least: float | None, most: float | None) -> None:
    """Refuse to answer where it hangs on how much of its box a shape fills.

    Args:
        boxed: what was measured with meshes and height fields as their boxes.
        bare: the same without them; the truth lies between.
        least: the range that is asked for, open where None.
        most: its other end.

    Raises:
        UnknowableError: an end of the range lies between the two.
    """
    if (least is not None and (boxed >= least) != (bare >= least)) or (
        most is not None and (boxed <= most) != (bare <= most)
    ):
        raise UnknowableError(
            f"it hangs on a mesh or height field, known here by its box: {boxed:.3g} with its box, {bare:.3g} without",
            next_move="give what stands between shapes that are cast exactly (box, sphere, ellipsoid, capsule, cylinder), "
            "or ask for what holds either way",
        )
