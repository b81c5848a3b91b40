"""A body is still moving at the end although it should have come to rest.

What it means: either the recording is too short for the claim, or something keeps feeding the motion. Long motion by
itself is no fault: a pendulum rings for minutes and a ball rolls on.

Formula: over the last quarter of the recording (at least 0.5 s), u is the rms of the speed plus half of r times the
spin. Judged only for a body that the plan says rests or stays, for a dynamic body that no step expects to move, and,
without a plan, for a loose body that stays in contact, within twice its own size and unspinning, and whose u in the second
half of the window keeps 0.8 of the first's. What an expectation of the plan has proved to rest up to the end rests.
Threshold: u > 0.02 sqrt(g r). Severity: blocking where the plan claims rest, a warning where no step expects motion, and a
remark without a plan, since a recording may end before its motion does.
Source: the reference paper's scanner.
"""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import Any

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from .. import resting
from ..sign import Case, Context, Sign

CODE = "WS107"
RELATIVE = True
REPAIR = "object_settlement"
SHOWN_AS = "speed"
NEEDS = ("linvel",)
WHOLE = True
OF_CLAIM = True
SPEED_FRACTION = 0.02
MOST_OTHERS = 8


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that do not settle."""
    span = max(0.5, trajectory.duration_s / 4)
    if trajectory.duration_s < 2 * span:
        return
    end = trajectory.rows(float(trajectory.t[-1]) - span)
    limit = SPEED_FRACTION * trajectory.speed_scale
    u = trajectory.speed[end] + 0.5 * trajectory.size_m * trajectory.spin[end]
    half = len(u) // 2
    first, second = _rms(u[:half]), _rms(u[half:])
    at_rest = resting.proved(trajectory, context)
    unsettled = np.flatnonzero((second > limit) & trajectory.moves_freely)
    for b in unsettled:
        name = trajectory.names[b]
        if name in at_rest:
            continue
        if name in context.rests:
            others = [f"{trajectory.names[o]} ({second[o]:.2g} m/s)" for o in unsettled if o != b]
            severity, why = "blocking", _asked(context, name, others)
        elif context.planned and name not in context.movers and trajectory.mechanics.free is not None:
            if not trajectory.mechanics.free[b]:
                continue
            severity, why = "warn", "and no step of the plan expects it to move"
        elif not context.planned and second[b] > 0.8 * first[b] and _fidgets(trajectory, b, end):
            severity, why = "info", "and is not calming down"
        else:
            continue
        window = (trajectory.t[end.start], trajectory.t[-1])
        message = f"{name} still moves at {second[b]:.3g} m/s at the end, {why}"
        yield Sign(name, window, second[b], limit[b], "m/s", severity, message)


def _asked(context: Context, name: str, others: Sequence[str]) -> str:
    """From which words of the plan it follows that a body rests, what else still moves, and what to claim of one that does."""
    claims = [(claim, given) for claim, given in context.rest_claims if name in _bodies(given)]
    claim = claims[0][0] if claims else "a claim"
    said = f"although `{claim}` in the plan's objectives asks it to rest"
    if others:
        more = f" and {len(others) - MOST_OTHERS} more" if len(others) > MOST_OTHERS else ""
        said += f"; so do {', '.join(others[:MOST_OTHERS])}{more}"
    if claim == "stays":
        said += "; of what something still moves, as a wind does, claim `stays_within`, or give `stays` an earlier `window_s`"
    return said


def _bodies(given: Mapping[str, Any]) -> tuple[str, ...]:
    return (str(given.get("body") or ""), *map(str, given.get("bodies") or ()))


def _rms(values: np.ndarray) -> np.ndarray:
    return np.sqrt(np.mean(values**2, axis=0))


def _fidgets(trajectory: Trajectory, b: int, end: slice) -> bool:
    """Whether a body is loose and on its support, goes nowhere and does not spin like a top."""
    touching, free = trajectory.touching, trajectory.mechanics.free
    if touching is None or (free is not None and not free[b]):
        return False
    if touching[end, b].mean() <= 0.5:
        return False
    excursion = np.ptp(trajectory.pos[end, b], axis=0).max()
    spin = np.abs(trajectory.angvel[end, b].mean(axis=0)).max() * trajectory.size_m[b]
    swing = _rms(trajectory.speed[end, b])
    return bool(excursion < 2 * trajectory.size_m[b] and spin < 3 * swing)


def _rocking() -> Case:
    still = analytic.resting(4.0)
    pos, speed = still.pos.copy(), still.linvel.copy()
    pos[:, 0, 0] += 0.02 * np.sin(8 * still.t)
    speed[:, 0, 0] = 0.16 * np.cos(8 * still.t)
    return Case("a body that keeps rocking in place", replace(still, pos=pos, linvel=speed), severity="info")


def _claimed() -> Case:
    context = Context(planned=True, movers=("ball",), rests=("ball",))
    return Case("a rolling ball claimed to rest", analytic.rolling(), context, severity="blocking")


def _late(claimed: dict[str, Any], title: str, **wanted: Any) -> Case:
    """A body is braked to rest after 3.7 s of 4: in the last quarter it still moves."""
    claims = (("comes_to_rest", {"body": "body", **claimed}),)
    context = Context(planned=True, movers=("body",), rests=("body",), rest_claims=claims)
    return Case(title, analytic.sliding(3.7, 1.0, 4.0), context, **wanted)


GOOD = (
    lambda: _late({"before_s": 3.75}, "a body proved to rest from just before the end"),
    lambda: Case("a long-ringing pendulum", analytic.swinging(seconds=8.0)),
    lambda: Case("a ball rolling on", analytic.rolling()),
    lambda: Case("a mover of the plan", analytic.rolling(), Context(planned=True, movers=("ball",))),
    lambda: Case("a body braked to rest", analytic.sliding(1.0, 1.0, 4.0), Context(planned=True, rests=("body",))),
)
BAD = (
    _rocking,
    _claimed,
    lambda: _late({"before_s": 3.4}, "a body claimed to rest earlier than it does", severity="blocking"),
    lambda: _late({"before_s": 3.0, "max_speed_m_s": 2.0}, "what is called rest is none", severity="blocking"),
)
