"""What fastens and drives: ropes and springs between points of bodies, motors and servos on joints, and their control."""

import math

from ..model.drives import Actuator, End
from ..model.objects import Vec3
from ..model.plan import Plan
from ..model.scene import Scene
from .needs import Needs
from .source import Raw, call, comment, constant_name, literal

SIDES = {
    "center": (0, 0, 0),
    "front": (1, 0, 0),
    "back": (-1, 0, 0),
    "left": (0, 1, 0),
    "right": (0, -1, 0),
    "top": (0, 0, 1),
    "bottom": (0, 0, -1),
}


def tendons(plan: Plan, scene: Scene, needs: Needs) -> str:
    """Ropes and springs, between points of the bodies where they were placed."""
    lines = []
    for row in plan.topology.tendons:
        needs.use("tendons")
        ends = [(end.body, point(end, plan, scene)) for end in row.ends]
        keywords: dict = {"stiffness": row.stiffness} if row.stiffness else {}
        keywords |= {k: getattr(row, k) for k in ("length", "slack", "damping", "time_constant") if getattr(row, k)}
        keywords |= {"diameter": row.diameter} | ({"look": row.look} if row.look else {})
        made = "tendons.spring" if row.stiffness else "tendons.rope"
        lines.append(call(made, Raw("spec"), row.name, ends, **keywords))
    return "\n".join(lines)


def point(end: End, plan: Plan, scene: Scene) -> Vec3:
    """Where an end is fastened, metres, world frame.

    A side is a side of the object itself, turned with it: about its own x by `deg_x`, then about z by its yaw, which is
    the order of `worldkit.bodies` (the shape is tilted inside its body, the body is yawed). Sizes are before the tilt.
    """
    if end.body == "world":
        return end.offset
    placed = scene[end.body]
    row = next((row for row in plan.scene_objects if row.name == end.body), None)
    size, tilt_deg = (placed.size, 0.0) if row is None else (row.size, row.deg_x)
    away = row.tilt_shift if row is not None else (0.0, 0.0, 0.0)
    x, y, z = (side * extent / 2 + more for side, extent, more in zip(SIDES[end.at], size, end.offset, strict=True))
    y, z = _turned(y, z, tilt_deg)
    x, y, z = x + away[0], y + away[1], z + away[2]
    x, y = _turned(x, y, placed.deg_z)
    cx, cy, cz = (float(c) for c in placed.position)
    return (round(cx + x, 9) + 0.0, round(cy + y, 9) + 0.0, round(cz + z, 9) + 0.0)


def _turned(a: float, b: float, deg: float) -> tuple[float, float]:
    """A point of a plane, counter-clockwise by `deg` degrees."""
    c, s = math.cos(math.radians(deg)), math.sin(math.radians(deg))
    return a * c - b * s, a * s + b * c


def actuators(plan: Plan, needs: Needs) -> str:
    """Motors and servos on the joints."""
    lines = []
    for row in plan.topology.actuators:
        if row.kind == "imported":
            continue
        needs.use("actuators")
        keywords: dict = {"joint": row.joint}
        keywords |= {k: getattr(row, k) for k in ("gain", "damping", "limit") if getattr(row, k)}
        lines.append(call(f"actuators.{row.kind}", Raw("spec"), row.name, **keywords))
    return "\n".join(lines)


def control(plan: Plan, needs: Needs) -> str:
    """The `control` function: constant controls of the plan's actuators; what else it declares is marked."""
    interventions = plan.simulation_parameters.interventions
    driven = {row.name: row for row in plan.topology.actuators if row.control is not None}
    if not interventions and not driven:
        return ""
    lines = ["\ndef control(model: mujoco.MjModel, data: mujoco.MjData) -> None:"]
    lines.append('    """What the plan declares to act on the state besides the engine."""')
    for name, row in driven.items():
        value = constant_name(row.control) if isinstance(row.control, str) else literal(row.control)
        lines.append(f"    data.actuator({literal(name)}).ctrl[0] = {value}")
    for item in interventions:
        text = f"{item.kind} on {', '.join(item.bodies)}: {item.law} (trigger: {item.trigger}; source: {item.source})"
        if item.kind == "control" and driven and set(item.bodies) <= driven_names(plan, driven):
            lines.insert(2, comment(text))
            continue
        needs.leave(f"declared intervention: {text}", "its law, in control()")
        lines.append(comment(f"AUTHOR: {text}"))
    return "\n".join(lines) + "\n"


def driven_names(plan: Plan, driven: dict[str, Actuator]) -> set[str]:
    """The actuators whose control the plan gives, their joints, and the bodies on those."""
    joints = {row.joint for row in driven.values()}
    children = {joint.child for joint in plan.topology.joints if joint.name in joints}
    return {*driven, *joints, *children}
