"""Write what fastens and drives: ropes, springs and rods between bodies, motors and servos on joints, and their control."""

import re

from ..model.plan.committed import Intervention, Plan, SimulationParameters
from ..model.plan.drives import Actuator
from ..model.plan.fastening import point
from ..model.plan.layout import Scene
from ..model.plan.trigger import always, threshold
from . import robots_text
from .python_text import Raw, call, comment, constant_name, literal
from .requirements import Needs
from .vehicles_text import commanded

LETS_GO = re.compile(r"\b(break|releas|let|snap|cut|open|tear|switch|fail)", re.IGNORECASE)
"""What is said of a constraint that does not hold throughout."""


def tendons(plan: Plan, scene: Scene, needs: Needs) -> str:
    """Write ropes, springs and rods between points of the placed bodies."""
    lines = []
    for row in plan.topology.tendons:
        needs.use("tendons")
        ends = [(end.body, point(end, plan, scene)) for end in row.ends]
        keywords: dict = {"stiffness": row.stiffness} if row.stiffness else {}
        keywords |= {
            k: getattr(row, k) for k in ("length", "slack", "pretension", "damping", "time_constant") if getattr(row, k)
        }
        keywords |= {"diameter": row.diameter} | ({"look": row.look} if row.look else {})
        made = "tendons.rod" if row.rod else "tendons.spring" if row.stiffness else "tendons.rope"
        lines.append(call(made, Raw("spec"), row.name, ends, **keywords))
    return "\n".join(lines)


def actuators(plan: Plan, needs: Needs) -> str:
    """Write motors and servos on the joints."""
    lines = []
    for row in plan.topology.actuators:
        if row.kind == "imported":
            continue
        needs.use("actuators")
        keywords: dict = {"joint": row.joint}
        keywords |= {k: getattr(row, k) for k in ("gain", "damping", "limit") if getattr(row, k)}
        lines.append(call(f"actuators.{row.kind}", Raw("spec"), row.name, **keywords))
    return "\n".join(lines)


def ties(plan: Plan, needs: Needs) -> str:
    """Mark where constraints that hold throughout are built, such as a thread: `control` would have nothing to do for them."""
    lines = []
    for row in filter(_ties, plan.simulation_parameters.interventions):
        known = {*needs.joint_kinds, *(joint.name for joint in plan.topology.joints)}
        said = [
            word for word in dict.fromkeys(re.findall(r"[\w-]+", f"{' '.join(row.bodies)} {row.law}")) if word in known
        ]
        called = next((name for name in row.bodies if name not in known), row.bodies[0])
        kind, ends = "mjEQ_JOINT", said[:2]
        if len(ends) < 2:
            kind, ends = "mjEQ_...", ["...", "..."]
        made = f"spec.add_equality(name={called!r}, type=mujoco.mjtEq.{kind}, name1={ends[0]!r}, name2={ends[1]!r})"
        what = f"it holds throughout, so it is an equality of the model, here in build(), not in control(): `{made}`, and its data"
        needs.leave(f"declared constraint on {', '.join(row.bodies)}: {row.law}", what)
        lines.append(
            comment(f"AUTHOR: constraint on {', '.join(row.bodies)}: {row.law} (source: {row.source}); {what}.")
        )
    return "\n".join(lines)


def _ties(row: Intervention) -> bool:
    return row.kind == "constraint" and always(row.trigger) and not LETS_GO.search(row.law)


def control(plan: Plan, needs: Needs) -> str:
    """Write the `control` function: constant controls of the plan's actuators, and marks for what else it declares."""
    parameters = plan.simulation_parameters
    # Neither a solver beside the engine nor the wind of the medium, which `build` has, needs anything from here.
    acting = [row for row in parameters.interventions if row.solver is None and not _ties(row)]
    interventions = [row for row in acting if not _said_again(row, parameters)]
    driven = {row.name: row for row in plan.topology.actuators if row.control is not None}
    drivers, blown = commanded(plan) | robots_text.commanded(plan), robots_text.blown(plan)
    if not interventions and not driven:
        return ""
    bonded = {name for whole in plan.broken for name in plan.families[whole]}
    lines = ["\ndef control(model: mujoco.MjModel, data: mujoco.MjData) -> None:"]
    lines.append('    """What the plan declares to act on the state besides the engine."""')
    lines += filter(None, drivers.values())
    for name, row in driven.items():
        value = constant_name(row.control) if isinstance(row.control, str) else literal(row.control)
        lines.append(f"    data.actuator({literal(name)}).ctrl[0] = {value}")
    for item in interventions:
        text = f"{item.kind} on {', '.join(item.bodies)}: {item.law} (trigger: {item.trigger}; source: {item.source})"
        if item.bodies in drivers or item.law in blown:
            continue
        if item.kind == "control" and driven and set(item.bodies) <= driven_names(plan, driven):
            lines.insert(2, comment(text))
            continue
        if item.kind == "constraint" and set(item.bodies) <= bonded and threshold(item.trigger) is not None:
            whole = [name for name, row in plan.broken.items() if {*row.instances} & {*item.bodies}]
            lines += [comment(f"constraint on {', '.join(whole)}: {item.law} ({item.trigger})")]
            lines += [] if "    LET_GO(model, data)" in lines else ["    LET_GO(model, data)"]
            continue
        needs.leave(f"declared intervention: {text}", "its law, in control()")
        lines.append(comment(f"AUTHOR: {text}"))
    if "    LET_GO(model, data)" in lines:
        lines.insert(0, "\nLET_GO = breaking.LettingGo()\n")
    return "\n".join(lines) + "\n"


def _said_again(row: Intervention, parameters: SimulationParameters) -> bool:
    """Whether a row only says that the medium's wind blows, which it does always: a gust with a moment of its own is more."""
    blows = parameters.medium is not None and any(parameters.medium.wind)
    return blows and row.kind == "force" and set(row.bodies) == {"wind"} and always(row.trigger)


def driven_names(plan: Plan, driven: dict[str, Actuator]) -> set[str]:
    """Names of the actuators whose control the plan gives, of their joints, and of the bodies on those."""
    joints = {row.joint for row in driven.values()}
    children = {joint.child for joint in plan.topology.joints if joint.name in joints}
    return {*driven, *joints, *children}
