"""The plan may be approved without a person: every value that a planner chose is marked as inferred.

A value needs no mark when the prompt states it or when it names its source. This covers what changes the outcome: the
time step, the duration, masses, starting motion, non-standard gravity,
what drivers of vehicles do and the way they take, where robots walk, reach and fly, and material constants. That each mark names a
value that exists is `WP124`.

Why: in auto mode nobody reads the plan before the code is written, so what was assumed must be readable afterwards.
"""

import re
from collections.abc import Iterator
from typing import Any

from ...model.plan.breakage import stated_masses
from ...model.plan.committed import Plan
from ...model.plan.flight_rows import Gusting
from ...model.plan.vehicle_rows import rolling
from ...model.plan.walking_rows import Plays
from ..refusal import Refusal
from ..state import State

CODE = "WG011"
SECTION = "simulation_parameters."
VEHICLES = "assets."
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
                cause=f"{'' if name.startswith(VEHICLES) else SECTION}{name} was chosen by the planner and is not marked",
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
    rolls = rolling(plan)
    for name, motion in parameters.initial_motion.items():
        if motion.joint_velocity == rolls.get(name, 0.0) and name in rolls:
            continue  # it follows from the vehicle's speed and its wheels' radius
        numbers = [*motion.linear, *motion.angular, motion.joint_position or 0.0, motion.joint_velocity or 0.0]
        if any(numbers):
            yield f"initial_motion.{name}", [abs(v) for v in numbers if v]
    yield from _driven(plan)
    yield from _robots(plan)
    for name, material in parameters.materials.items():
        if not material.source:
            yield f"materials.{name}", [float("nan")]


def _driven(plan: Plan) -> Iterator[tuple[str, list[float]]]:
    """What drivers do; a vehicle's own numbers have a source, and defaults were not chosen."""
    for row in plan.assets:
        if row.vehicle is None:
            continue
        way = f"{VEHICLES}{row.name}.vehicle"
        if (follows := row.vehicle.follows) is not None:
            usual = type(follows).model_fields
            yield f"{way}.follows.path", [abs(number) for point in follows.path for number in point]
            if follows.closed:  # no number of the prompt could say so
                yield f"{way}.follows.closed", [float("nan")]
            for name in ("speed_m_s", "across_m_s2", "faster_m_s2", "slower_m_s2", "left_m"):
                if (value := getattr(follows, name)) != usual[name].default:
                    yield f"{way}.follows.{name}", [abs(value)]
        for index, given in enumerate(row.vehicle.inputs):
            for name in ("t", "over_s", "steering_deg", "throttle", "brake"):
                if value := getattr(given, name):
                    yield f"{way}.inputs.{index}.{name}", [abs(value)]


def _robots(plan: Plan) -> Iterator[tuple[str, list[float]]]:
    """Where robots are told to walk, reach or fly; defaults were not chosen."""
    chosen = {
        "walks": ("speed_m_s", "until_s", "y_m", "heading_deg", "plays"),
        "picks": ("board", "from_s", "speed_m_s"),
        "flies": ("through", "speed_m_s", "hover_s", "gusts"),
    }
    for row in plan.assets:
        for does, names in chosen.items():
            told = getattr(row, does)
            for name in names if told is not None else ():
                if (value := getattr(told, name)) != type(told).model_fields[name].default:
                    yield f"{VEHICLES}{row.name}.{does}.{name}", _sizes(value)


def _sizes(value: Any) -> list[float]:
    """The numbers in what was chosen, without their signs."""
    if isinstance(value, int | float):
        return [abs(value)]
    if isinstance(value, Plays):
        return _sizes(value.goal)
    if isinstance(value, Gusting):
        return _sizes((value.mean_m_s, value.strength_m_s))
    return [size for part in value for size in _sizes(part)]


def _numbers(state: State) -> set[float]:
    """Every number that the prompt states."""
    try:
        text = state.run.prompt.read_text(encoding="utf-8", errors="replace")
    except OSError:
        return set()
    return {float(number) for number in re.findall(r"\d+(?:\.\d+)?(?:[eE][-+]?\d+)?", text)}
