"""What acts is not what the plan says acts: a stronger push than its law, a push before its time, another gravity.

What it means: an exception was declared to have it pass, and something else was done. A declaration is read with the
report; what is done must be what was read.

Formula: for a declared force, torque or velocity whose law states numbers in that kind's unit, the largest magnitude in the
ledger against the largest number stated (kN and mN·m converted); numbers without such a unit state nothing. For a
trigger that is a time (`at t = 2 s`, `from 1 s to 1.5 s`), the first act against the earliest time stated and, where
two are stated, the last act against the latest. The recording's gravity against the plan's.
Threshold: 5 % and 1e-6 of the number; 20 ms, or three recorded rows, of time; 0.02 m/s^2 of gravity (9.80665 or 9.81). Blocking.
Source: the architecture's "Interventions are recorded".
"""

import re
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ...model.plan import Intervention, Plan, SimulationParameters
from ...model.trajectory import Trajectory
from .. import analytic
from ..declared import when
from ..sign import Case, Context, Sign

CODE = "WS317"
NEEDS = ("pos",)
SHARE, DELAY_S, GRAVITY = 0.05, 0.02, 0.02
NUMBER = r"(?P<number>\d+(?:\.\d+)?(?:[eE][-+]?\d+)?)\s*"
UNITS = {
    "force": re.compile(NUMBER + r"(?P<prefix>[kKmM]?)N(?![\w·*/.-]*m\b)(?![·*/]s)(?!\w)"),
    "torque": re.compile(NUMBER + r"(?P<prefix>[kKmM]?)N\s?[·* .]?\s?m(?!\w)(?![·*/]s)"),
    "velocity": re.compile(NUMBER + r"(?P<prefix>[kcm]?)(?:m|rad)/s(?![\w²^])"),
}
PREFIX = {"": 1.0, "k": 1e3, "K": 1e3, "c": 1e-2, "m": 1e-3, "M": 1e6}
ENDS = re.compile(r"\b(until|till|before|up to)\b|<", re.IGNORECASE)
SECONDS = re.compile(r"(\d+(?:\.\d+)?)\s*(ms|s\b|seconds?)")


def stated(law: str, kind: str) -> float | None:
    """The largest magnitude that a law states in the unit of its kind; None when it states none."""
    if kind not in UNITS:
        return None
    found = [float(m["number"]) * PREFIX[m["prefix"]] for m in UNITS[kind].finditer(law)]
    return max(found, default=None)


def times(trigger: str) -> tuple[float, float]:
    """From when until when a trigger by the clock says that it acts, in s; infinite where it does not say."""
    if when(trigger) != "time":
        return -np.inf, np.inf
    text = re.sub(r"(\d+(?:\.\d+)?)\s*(?:\.\.|to|and|-|–)\s*(?=\d+(?:\.\d+)?\s*(?:ms|s))", r"\1 s to ", trigger)
    said = sorted(float(number) * (1e-3 if unit == "ms" else 1.0) for number, unit in SECONDS.findall(text))
    if len(said) == 1:
        return (-np.inf, said[0]) if ENDS.search(trigger) else (said[0], np.inf)
    return (said[0], said[-1]) if said else (-np.inf, np.inf)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each declaration that the recording does not keep."""
    if context.plan is not None and trajectory.mechanics.gravity is not None:
        meant = np.asarray(context.plan.simulation_parameters.gravity_vector)
        off = float(np.sqrt(((trajectory.gravity - meant) ** 2).sum()))
        if off > GRAVITY:
            here = ", ".join(f"{v:.4g}" for v in trajectory.gravity)
            message = f"gravity is ({here}) m/s^2; the plan says ({', '.join(f'{v:.4g}' for v in meant)})"
            whole = (trajectory.t[0], trajectory.t[-1])
            yield Sign("world", whole, off, GRAVITY, "m/s^2", "blocking", message)
    ledger = trajectory.interventions
    if ledger is None:
        return
    kinds, targets = np.asarray(ledger.kind, dtype=str), np.asarray(ledger.target, dtype=str)
    for row in context.interventions:
        mine = np.array(
            [
                kind == row.kind and Context(interventions=(row,)).declares(str(kind), str(target))
                for kind, target in zip(kinds, targets, strict=True)
            ],
            dtype=bool,
        )
        if mine.any():
            yield from _stronger(trajectory, row, mine)
            yield from _other_time(trajectory, row, mine)


def _stronger(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    ledger, most = trajectory.interventions, stated(row.law, row.kind)
    assert ledger is not None
    if most is None:
        return
    value = np.asarray(ledger.value)[mine]
    part = value[:, 3:] if row.kind == "torque" and np.any(value[:, 3:]) else value[:, :3]
    size = np.sqrt((part**2).sum(axis=1))
    worst = int(np.argmax(size))
    if size[worst] <= most * (1 + SHARE) + 1e-6:
        return
    unit = {"force": "N", "torque": "N·m", "velocity": "m/s"}[row.kind]
    time = float(np.asarray(ledger.time)[mine][worst])
    message = f"the {row.kind} on {row.bodies[0]} reaches {size[worst]:.3g} {unit}; its declared law says {most:.3g}"
    yield Sign(row.bodies[0], (time, time), size[worst], most, unit, "blocking", message)


def _other_time(trajectory: Trajectory, row: Intervention, mine: np.ndarray) -> Iterator[Sign]:
    ledger = trajectory.interventions
    assert ledger is not None
    begin, end = times(row.trigger)
    acted = np.asarray(ledger.time)[mine]
    first, last, slack = float(acted.min()), float(acted.max()), max(DELAY_S, 3 * trajectory.interval_s)
    early, late = begin - first, last - end
    if max(early, late) <= slack:
        return
    message = f"the {row.kind} on {row.bodies[0]} acts from {first:.3g} s to {last:.3g} s; declared: {row.trigger}"
    yield Sign(row.bodies[0], (first, last), max(early, late), slack, "s", "blocking", message)


def _pushed(value: float, law: str = "5 N along +x", trigger: str = "always") -> Case:
    row = Intervention(kind="force", bodies=("body",), law=law, trigger=trigger, source="the prompt")
    push = replace(analytic.resting(), interventions=analytic.pushed(value=value))
    return Case(f"{value:g} N declared as {law}, {trigger}", push, Context(planned=True, interventions=(row,)))


def _gravity(z: float) -> Case:
    plan = Plan.model_construct(
        plan_type="scene",
        simulation_parameters=SimulationParameters(time_step=0.001, simulation_duration=1.0, gravity=z),
        objectives=(),
        scene_objects=(),
        assets=(),
    )
    return Case(f"the plan says {z:g} m/s^2", analytic.resting(), Context(planned=True, plan=plan))


GOOD = (
    lambda: _pushed(5.0),
    lambda: _pushed(40.0, "as the wind: rho c A v^2 / 2, v = 3 m/s"),
    lambda: _pushed(60.0, "at most 0.06 kN, less 40 N·s/m of the speed"),
    lambda: _pushed(5.0, trigger="t in 0.1..0.11 s"),
    lambda: _pushed(5.0, trigger="until 0.8 s"),
    lambda: _gravity(-analytic.G),
)
BAD = (
    lambda: replace(_pushed(50.0), severity="blocking"),
    lambda: replace(_pushed(5.0, trigger="at t = 2 s"), severity="blocking"),
    lambda: replace(_pushed(5.0, trigger="from 0.02 s to 0.05 s"), severity="blocking"),
    lambda: replace(_gravity(-1.62), severity="blocking"),
)
