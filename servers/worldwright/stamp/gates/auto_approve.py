"""The plan may be approved without a person: every value that a planner chose is marked as inferred.

A value needs no mark when the prompt states it or when it names its source. This covers what changes the outcome: the
time step, the duration, masses, starting motion, non-standard gravity, and material constants. That each mark names a
value that exists is `WP124`.

Why: in auto mode nobody reads the plan before the code is written, so what was assumed must be readable afterwards.
"""

import re
from collections.abc import Iterator

from ...model.plan.breakage import stated_masses
from ...model.plan.committed import Plan
from ..refusal import Refusal
from ..state import State

CODE = "WG011"
SECTION = "simulation_parameters."
STANDARD_GRAVITY = {-9.81, -9.80665, -9.8}


def check(state: State) -> Iterator[Refusal]:
    """Refusals for values that have no source, are not in the prompt and are not marked (marks that lead nowhere are WP124)."""
    if state.plan is None:
        return
    marks = tuple(mark.removeprefix(SECTION) for mark in state.plan.simulation_parameters.inferred)
    said = _numbers(state)
    for name, values in _chosen(state.plan):
        # Marking a part (`initial_motion.pivot.joint_position`) marks what the person is shown with it.
        marked = any(name == mark or name.startswith(mark + ".") or mark.startswith(name + ".") for mark in marks)
        if not marked and not all(any(abs(v - s) <= 1e-9 * max(1, abs(s)) for s in said) for v in values):
            yield Refusal(
                cause=f"{SECTION}{name} was chosen by the planner and is not marked",
                next_move=f"add `{name}` to {SECTION}inferred in {state.place}/plan.md, or give its source",
            )


def _chosen(plan: Plan) -> Iterator[tuple[str, list[float]]]:
    """Values that need a mark unless the prompt states them: (dotted name, numbers)."""
    parameters = plan.simulation_parameters
    for name in ("time_step", "simulation_duration"):
        value = getattr(parameters, name)
        if not isinstance(value, str):
            yield name, [value]
    if parameters.gravity_vector[2] not in STANDARD_GRAVITY or any(parameters.gravity_vector[:2]):
        yield "gravity", [abs(v) for v in parameters.gravity_vector if v]
    pieces = {piece for name in plan.broken for piece in plan.families[name]}
    for name, mass in parameters.masses.items():
        if name not in pieces:
            yield f"masses.{name}", [mass]
    for name, mass in stated_masses(plan).items():  # pieces have their shares of it
        yield f"masses.{name}", [mass]
    for name, motion in parameters.initial_motion.items():
        numbers = [*motion.linear, *motion.angular, motion.joint_position or 0.0, motion.joint_velocity or 0.0]
        if any(numbers):
            yield f"initial_motion.{name}", [abs(v) for v in numbers if v]
    for name, material in parameters.materials.items():
        if not material.source:
            yield f"materials.{name}", [float("nan")]


def _numbers(state: State) -> set[float]:
    """Every number that the prompt states."""
    try:
        text = state.run.prompt.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return set()
    return {float(number) for number in re.findall(r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?", text)}
