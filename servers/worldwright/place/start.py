"""Compute the pose in which the simulation starts: the layout with the joint positions of `initial_motion`.

A joint's anchor and axis are given in the world at the layout's pose, so that the rigid motion x' = R x + t of a child is
its parent's motion after its own turn about that line (or shift along it). Ropes and springs run between points of bodies,
which move along.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from worldkit.tendons import ROUNDED_M

from ..model.plan.committed import Joint, Plan
from ..model.plan.drives import Tendon
from ..model.plan.fastening import point
from ..model.plan.layout import Scene
from ..model.plan.scene_objects import Vec3
from .anchors import shown

WORLD = "world"
Rows = tuple[Vec3, Vec3, Vec3]
STILL: Rows = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class Motion:
    """x' = R x + t in the world frame, metres."""

    rotation: Rows = STILL
    shift: Vec3 = (0.0, 0.0, 0.0)

    def __call__(self, point: Vec3) -> Vec3:
        """The place to which it moves a point, m."""
        x, y, z = (sum(a * b for a, b in zip(row, point, strict=True)) for row in self.rotation)
        return (x + self.shift[0], y + self.shift[1], z + self.shift[2])

    def after(self, first: "Motion") -> "Motion":
        """This motion after another."""
        columns = list(zip(*first.rotation, strict=True))
        a, b, c = (tuple(sum(p * q for p, q in zip(row, col, strict=True)) for col in columns) for row in self.rotation)
        return Motion((_vec(a), _vec(b), _vec(c)), self(first.shift))


def motions(plan: Plan, scene: Scene) -> dict[str, Motion]:
    """The motion of each placed object that does not start where it was laid out."""
    joints = {joint.child: joint for joint in reversed(plan.topology.joints)}  # a child's first row is its joint
    starts = {n: m.joint_position for n, m in plan.simulation_parameters.initial_motion.items() if m.joint_position}
    placed = {o.name: o.position for o in scene.objects}

    def motion(name: str, trail: tuple[str, ...] = ()) -> Motion:
        joint = joints.get(name)
        if joint is None or name in trail:
            return Motion()
        own = _turned(joint, starts.get(joint.name), placed.get(name))
        return motion(joint.parent, (*trail, name)).after(own)

    found = {name: motion(name) for name in placed}
    return {name: one for name, one in found.items() if one != Motion()}


def _turned(joint: Joint, position: float | None, centre: Vec3 | None) -> Motion:
    anchor = joint.anchor or centre
    length = math.hypot(*joint.axis)
    if not position or anchor is None or not length:
        return Motion()
    x, y, z = (part / length for part in joint.axis)
    if joint.type == "slide":
        return Motion(shift=(x * position, y * position, z * position))
    if joint.type != "hinge":
        return Motion()
    # Rodrigues' formula: R = cos I + sin [n]x + (1 - cos) n n'.
    c, s = math.cos(math.radians(position)), math.sin(math.radians(position))
    k = 1 - c
    turn = Motion(
        (
            (c + k * x * x, k * x * y - s * z, k * x * z + s * y),
            (k * x * y + s * z, c + k * y * y, k * y * z - s * x),
            (k * x * z - s * y, k * y * z + s * x, c + k * z * z),
        )
    )
    away = turn(anchor)
    return Motion(turn.rotation, (anchor[0] - away[0], anchor[1] - away[1], anchor[2] - away[2]))


def way(plan: Plan, scene: Scene, tendon: Tendon, moved: dict[str, Motion] | None = None) -> list[Vec3] | None:
    """The points through which a tendon runs, m, world frame; None while one of its bodies is not placed.

    Args:
        plan, scene: the plan and its layout.
        tendon: a row of `topology.tendons`.
        moved: the result of `motions` for the way at the start; None for the way as laid out.
    """
    points = []
    for end in tendon.ends:
        try:
            at = point(end, plan, scene)
        except KeyError:
            return None
        points.append((moved or {}).get(end.body, Motion())(at))
    return points


@dataclass(frozen=True)
class Hung:
    """A rope, spring or rod at the start: the length of its way, and its own."""

    tendon: Tendon
    way_m: float
    laid_m: float
    """The length of its way as laid out, before `initial_motion`, by which the program measures it, m."""

    @property
    def length_m(self) -> float:
        """The greatest length of a rope, or a spring's length at rest, m."""
        return self.laid_m + self.tendon.slack if self.tendon.length is None else self.tendon.length

    @property
    def slack_m(self) -> float:
        """How much longer it is than its way, m; negative if it is too short or stretched."""
        return self.length_m - self.way_m

    @property
    def text(self) -> str:
        """One line."""
        name, slack = self.tendon.name, self.slack_m
        size = f"{_mm(self.way_m)} m from end to end at the start, {_mm(self.length_m)} m"
        if self.tendon.stiffness:
            force = f"{abs(self.tendon.stiffness * slack):.3g} N"
            does = "at rest" if abs(slack) < 1e-6 else f"{'pulls' if slack < 0 else 'pushes'} with {force}"
            return f"spring `{name}`: {size} at rest: {does}"
        if self.tendon.rod:
            fits = (
                "fits" if abs(slack) < ROUNDED_M else f"too {'long' if slack > 0 else 'short'} by {_mm(abs(slack))} m"
            )
            return f"rod `{name}`: {size} long: {fits}"
        does = (
            "taut"
            if abs(slack) < ROUNDED_M
            else f"slack by {_mm(slack)} m"
            if slack > 0
            else f"too short by {_mm(-slack)} m"
        )
        return f"rope `{name}`: {size} long: {does}"


def hung(plan: Plan, scene: Scene) -> Iterator[Hung]:
    """Every rope and spring whose bodies are placed."""
    moved = motions(plan, scene)
    for tendon in plan.topology.tendons:
        laid, start = way(plan, scene, tendon), way(plan, scene, tendon, moved)
        if laid is not None and start is not None:
            yield Hung(tendon, _length(start), _length(laid))


def told(plan: Plan, scene: Scene) -> Iterator[str]:
    """A line for each rope and spring, each joint that does not start at its layout's pose or at rest, and each loop."""
    yield from (one.text for one in hung(plan, scene))
    moved = motions(plan, scene)
    yield from _closed(plan, scene, moved)
    joints = {joint.name: joint for joint in plan.topology.joints}
    for name, start in plan.simulation_parameters.initial_motion.items():
        joint = joints.get(name)
        if joint is None or not (start.joint_position or start.joint_velocity):
            continue
        degrees = joint.type == "hinge"
        parts = []
        if start.joint_position:
            below = [n for n in moved if joint in list(_above(plan, n))]
            carried = f" (with it {', '.join(below[:6])})" if below else ""
            parts.append(f"{shown(start.joint_position)} {'deg' if degrees else 'm'} from its layout{carried}")
        if start.joint_velocity:
            parts.append(f"{shown(start.joint_velocity)} {'rad/s' if degrees else 'm/s'}")
        yield f"joint `{name}` starts at {' and at '.join(parts)}"


def _closed(plan: Plan, scene: Scene, moved: dict[str, Motion]) -> Iterator[str]:
    """Tell the number of joints that the start pose leaves out as they close loops, and the gap between the ends of each."""
    loops, count = plan.topology.loops(), len(plan.topology.joints)
    centres = {o.name: o.position for o in scene.objects}
    if loops:
        which = "1 closes a loop" if len(loops) == 1 else f"{len(loops)} close loops"
        yield f"{count} joints, of which {which} and no pose hangs on: {', '.join(f'`{j.name}`' for j in loops)}"
    for joint in loops:
        anchor = joint.anchor or centres.get(joint.child)
        if anchor is None:
            continue
        ends = [moved.get(name, Motion())(anchor) for name in (joint.parent, joint.child)]
        gap = math.dist(*ends)
        if gap > 1e-6:
            yield (
                f"joint `{joint.name}` closes a loop whose ends are {_mm(gap)} m apart at the start: "
                "the engine pulls them together at once; give the loop's other joints their `joint_position` too"
            )


def _above(plan: Plan, name: str) -> Iterator[Joint]:
    """The joints between an object and the world, its own first."""
    joints = {joint.child: joint for joint in reversed(plan.topology.joints)}
    seen: set[str] = set()
    while name in joints and name not in seen:
        seen.add(name)
        yield joints[name]
        name = joints[name].parent


def filtered(plan: Plan, fixed: set[str]) -> Any:
    """A function that tells whether the engine lets two objects overlap: they are welded together, or share one joint.

    What is welded to the world, or fixed, belongs to the world, whose joints filter nothing (manual, "Collision
    detection", filters).
    """
    joints = {joint.child: joint for joint in reversed(plan.topology.joints)}

    def piece(name: str) -> str:
        for _ in range(len(joints) + 1):
            joint = joints.get(name)
            if name in fixed and joint is None:
                return WORLD
            if joint is None or joint.type != "weld":
                return name
            name = joint.parent
        return name

    def parent(name: str) -> str:
        joint = joints.get(piece(name))
        return "" if joint is None else piece(joint.parent)

    def free(one: str, other: str) -> bool:
        a, b = piece(one), piece(other)
        return a == b or (parent(one) == b != WORLD) or (parent(other) == a != WORLD)

    return free


def _length(points: list[Vec3]) -> float:
    return sum(math.dist(a, b) for a, b in pairwise(points))


def _mm(value: float) -> str:
    return shown(round(value, 4))


def _vec(values: Any) -> Vec3:
    x, y, z = values
    return (x, y, z)
