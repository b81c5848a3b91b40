"""Vehicles as rows of a plan: what a row says, what its driver may do, and what a vehicle brings along.

`worldkit.vehicles` owns the numbers of each kind and refuses those with which none can stand. A vehicle that is driven declares the
controls of its actuators by that; one that is launched at a speed has its wheels rolling.
"""

import itertools
from math import cos, hypot, radians, sin
from typing import TYPE_CHECKING, Any, Literal

from pydantic import Field, model_validator

from ..frozen import Frozen
from . import numbered_kind
from .declared_inputs import Intervention

if TYPE_CHECKING:
    from worldkit.vehicles.adding import Vehicle as Made

Written = Any
"""A plan, or a part of it, whose module imports this one."""
Kind = Literal["car", "truck", "bus", "bicycle", "trailer", "tracked"]


class Follows(Frozen):
    """A driver who keeps to a course, slower where it bends."""

    path: tuple[tuple[float, float], ...] = ()
    """Points (x, y) on the ground, m; a smooth line runs through them."""
    road: str = ""
    """Instead, an asset of type `road`: along its reference line, round and round on a circuit."""
    left_m: float = Field(0.0, ge=-50, le=50)
    """How far to the left of the road's reference line."""
    closed: bool = False
    """Back to the first point, and on; else it stops at the last."""
    speed_m_s: float = Field(gt=0, le=120)
    """The most."""
    across_m_s2: float = Field(3.0, gt=0)
    """The most that it lets itself be pressed aside in bends."""
    faster_m_s2: float = Field(2.0, gt=0)
    slower_m_s2: float = Field(3.0, gt=0)

    @model_validator(mode="after")
    def _apart(self) -> "Follows":
        if bool(self.road) == bool(self.path) or (self.path and (len(self.path) < 2 + self.closed or self.left_m)):
            raise ValueError(
                "it follows a `path` of two points and more (three of a closed one), or a `road` (`left_m` beside its middle)"
            )
        ends = [*self.path, *self.path[:1]] if self.closed else self.path
        if any(hypot(a[0] - b[0], a[1] - b[1]) < 1e-6 for a, b in itertools.pairwise(ends)):
            raise ValueError("two points of a path that follow one another lie in one place")
        return self


class Given(Frozen):
    """What the driver does from a time on; what is left out stays as it was."""

    t: float = Field(ge=0)
    """s."""
    steering_deg: float | None = Field(None, ge=-60, le=60)
    """Of the wheels in the middle, to the left."""
    throttle: float | None = Field(None, ge=-1, le=1)
    """Share of the drive's most; below 0 backwards."""
    brake: float | None = Field(None, ge=0, le=1)
    """Share of the brakes' most."""
    over_s: float = Field(0.2, ge=0)
    """How long foot and hand take for it; what is given at t = 0 holds from there."""

    @property
    def done_s(self) -> float:
        """When it is done, s."""
        return round(self.t + self.over_s * (self.t > 0), 9)


class Vehicle(Frozen):
    """What an asset of type `vehicle` is, and how it is driven."""

    kind: Kind
    numbers: dict[str, int | float | str] = {}
    """What differs from the kind's own numbers, by their names in `worldkit.vehicles`."""
    source: str = ""
    """Where `numbers` come from."""
    follows: Follows | None = None
    inputs: tuple[Given, ...] = ()
    """Instead, what the driver does, in order of time."""

    @model_validator(mode="after")
    def _can_stand(self) -> "Vehicle":
        if self.numbers and not self.source.strip():
            raise ValueError("its `numbers` need a `source`: a data sheet, a table, a measurement")
        if self.follows is not None and self.inputs:
            raise ValueError("it has one driver: give it `follows` or `inputs`")
        if any(b.t < a.done_s for a, b in zip(self.inputs, self.inputs[1:], strict=False)):
            raise ValueError("each of its `inputs` begins after the one before it ends (`t` plus `over_s`)")
        if self.kind == "trailer" and self.driven:
            raise ValueError("a trailer has no driver: a ball in topology.joints hangs it on what draws it")
        self.made()
        return self

    def made(self) -> "Made":
        """The vehicle, of `worldkit.vehicles`.

        Raises:
            ValueError: a number that it does not have, or one with which it cannot stand.
        """
        vehicle: Made = numbered_kind.made("worldkit.vehicles", self.kind, tuple(sorted(self.numbers.items())))
        return vehicle

    @property
    def driven(self) -> bool:
        """Whether somebody drives it."""
        return self.follows is not None or bool(self.inputs)

    def commands(self) -> list[tuple[float, dict[str, float]]]:
        """Its `inputs` with all that holds at each time: before and after each change, since the driver moves in a line."""
        now, found = {"steering_deg": 0.0, "throttle": 0.0, "brake": 0.0}, list[tuple[float, dict[str, float]]]()
        for row in self.inputs:
            changed = {key: value for key in now if (value := getattr(row, key)) is not None}
            if row.t > 0:
                found.append((row.t, dict(now)))
            now |= changed
            found.append((row.done_s, dict(now)))
        return found


def parameters(plan: Written) -> Written:
    """The simulation parameters of a plan with what its vehicles declare: controls of driven ones, wheels that roll at the start."""
    given = plan.simulation_parameters
    acting, starts = list(given.interventions), dict(given.initial_motion)
    for row in plan.assets:
        for name in row.instances if row.vehicle is not None else ():
            by = drawn_by(plan, name)
            if row.vehicle.driven or (by and by[1].driven):
                control = _declared(row, name, row.vehicle.made(), by[0] if by and not row.vehicle.driven else "")
                acting += [] if control in acting else [control]
    for joint, speed in rolling(plan).items():
        some = next(iter(given.initial_motion.values()))
        starts.setdefault(joint, type(some)(joint_velocity=speed))
    return given.model_copy(update={"interventions": tuple(acting), "initial_motion": starts})


def drawn_by(plan: Written, name: str) -> tuple[str, Vehicle] | None:
    """The vehicle at the head of those that draw this one by balls of `topology.joints`: its name, and what it is."""
    parents = {joint.child: joint.parent for joint in reversed(plan.topology.joints) if joint.type == "ball"}
    rows = {instance: row.vehicle for row in plan.assets for instance in row.instances}
    by, seen = name, {name}
    while rows.get(above := parents.get(by, "")) is not None and above not in seen:
        by = above
        seen.add(by)
    return None if by == name else (by, rows[by])


def rolling(plan: Written) -> dict[str, float]:
    """How fast the wheels of each vehicle that is launched turn when they roll, rad/s, by joint."""
    found, starts = dict[str, float](), plan.simulation_parameters.initial_motion
    for row in plan.assets:
        for name in row.instances if row.vehicle is not None else ():
            drawing = drawn_by(plan, name)
            first = drawing[0] if drawing else name
            speed = _along(plan, first, starts[first].linear) if first in starts else 0.0
            joints = row.vehicle.made().axle_joints(name) if speed else {}
            found |= {joint: round(speed / radius, 9) for joint, radius in joints.items()}
    return found


def _along(plan: Written, name: str, velocity: tuple[float, ...]) -> float:
    """How fast a vehicle goes forward as it is placed, m/s; backwards is below 0."""
    turns = [row.orientation for row in plan.topology.scene_predicates if row.subject == name]
    yaw = radians(next((turn.deg_z for turn in reversed(turns) if hasattr(turn, "deg_z")), 0.0))
    return round(velocity[0] * cos(yaw) + velocity[1] * sin(yaw), 12)


def _declared(row: Written, name: str, vehicle: "Made", by: str = "") -> Intervention:
    follows = row.vehicle.follows
    law = (
        f"it brakes with {by}, which draws it"
        if by
        else f"the driver follows {follows.road or f'a path of {len(follows.path)} points'} at {follows.speed_m_s:g} m/s at most: steers towards it, "
        "accelerates and brakes"
        if follows is not None
        else f"the driver steers, accelerates and brakes as {len(row.vehicle.inputs)} inputs say"
    )
    said = "the driver of " + by if by else f"vehicle.{'follows' if follows is not None else 'inputs'}"
    source = f"assets: {row.name}, {said}"
    return Intervention(kind="control", bodies=vehicle.actuators(name), law=law, trigger="always", source=source)
