"""Tell whether an event in the world or the clock sets off what a program does at some moment.

The world is repeated slightly slower (weaker gravity, slower initial motion, weaker causes). A consequence then comes
later, or not at all; what comes at the same instant again was timed. A launch whose moment moves but whose speed never
does was fitted, not computed.
"""

from collections.abc import Iterator, Mapping

import numpy as np

from ...model.evidence.audits import Acting, TriggerResult
from ...model.finding import Anomaly
from ...model.plan.committed import Plan
from ...model.recording.trajectory import Trajectory

SLOWER = (0.9, 0.7)
"""Gravity and initial speeds are scaled by these shares."""
MOST = 12
STATES = ("pose", "velocity")
SAME = 1e-6
"""Written values whose relative difference is smaller are the same."""


def slower(plan: Plan, trajectory: Trajectory, factor: float) -> tuple[str, ...]:
    """The program's options for a world in which everything is slower; empty when nothing can be."""
    words: list[str] = []
    if np.any(trajectory.gravity):
        words += ["--weaken", f"gravity={factor:g}"]
    joints = {str(row["name"]) for row in trajectory.meta.get("joints") or ()}
    for name in plan.simulation_parameters.initial_motion:
        if name in trajectory.names:
            words += ["--weaken", f"{name}.velocity={factor:g}"]
        elif name in joints:
            words += ["--weaken", f"joint:{name}={factor:g}"]
    return tuple(words)


def discrete(acting: tuple[Acting, ...], step: float) -> list[Acting]:
    """The interventions that begin on the way, not at the start."""
    return [row for row in acting if row.first_s > 2.5 * step][:MOST]


def judge(trajectory: Trajectory, row: Acting, trials: Mapping[str, Trajectory]) -> TriggerResult:
    """Judge one intervention by all repetitions that differ from the original before it acted."""
    step = trajectory.time_step or trajectory.interval_s
    onsets = {label: _onset(other, row) for label, other in trials.items() if _differs(trajectory, other, row.first_s)}
    moved = {k: v for k, v in onsets.items() if v is None or abs(v - row.first_s) > 1.5 * step}
    values = [_values(trials[label], row) for label, onset in onsets.items() if onset is not None]
    first = _values(trajectory, row)
    varied = any(
        v.shape != first.shape or np.abs(v - first).max() > SAME * max(1.0, np.abs(first).max()) for v in values
    )
    said = f"{row.kind} on {row.target} at {row.first_s:.3f} s"
    if row.declared and row.when in ("time", "always"):
        outcome, message = "declared_time", f"{said}: declared to act by the clock ({row.trigger})"
    elif not onsets:
        outcome, message = "unclear", f"{said}: no repetition differed before it acted, so its trigger was not tested"
    elif not moved:
        outcome = "timed"
        message = f"{said} comes at the same instant in {len(onsets)} slower worlds: a clock sets it off"
        message += f", though the plan says `{row.trigger}`" if row.declared else ""
    elif row.kind in STATES and values and not varied:
        outcome = "fixed_size"
        message = f"{said}: its moment depends on the world, but what it writes is the same in all of them"
    else:
        outcome = "consequence"
        there = ", ".join(f"{label}: {'never' if at is None else f'{at:.3f} s'}" for label, at in onsets.items())
        message = f"{said} is set off by the world ({there})"
    return TriggerResult.model_validate(
        {
            "kind": row.kind,
            "target": row.target,
            "declared": row.declared,
            "declared_when": row.when,
            "onset_s": row.first_s,
            "onsets_s": onsets,
            "values_move": bool(varied),
            "outcome": outcome,
            "message": message,
        }
    )


def anomalies(results: tuple[TriggerResult, ...]) -> Iterator[Anomaly]:
    """`WS323`: a clock behind a declared consequence blocks; an undeclared intervention blocks in any case (WS108)."""
    for found in results:
        if found.outcome not in ("timed", "fixed_size"):
            continue
        yield Anomaly(
            code="WS323",
            name="timed_trigger",
            severity="blocking" if found.outcome == "timed" else "warn",
            body=found.target,
            window_s=(found.onset_s, found.onset_s),
            measured=0.0,
            threshold=0.0,
            unit="s",
            message=found.message,
        )


def _rows(trajectory: Trajectory, row: Acting) -> np.ndarray:
    ledger = trajectory.interventions
    if ledger is None:
        return np.zeros(0, dtype=int)
    pairs = zip(ledger.kind, ledger.target, strict=True)
    return np.array(
        [i for i, (kind, target) in enumerate(pairs) if kind == row.kind and target == row.target], dtype=int
    )


def _onset(trajectory: Trajectory, row: Acting) -> float | None:
    rows = _rows(trajectory, row)
    return float(trajectory.interventions.time[rows[0]]) if len(rows) and trajectory.interventions else None


def _values(trajectory: Trajectory, row: Acting) -> np.ndarray:
    rows = _rows(trajectory, row)
    assert trajectory.interventions is not None
    return np.asarray(trajectory.interventions.value[rows[:8]])


def _differs(one: Trajectory, other: Trajectory, until_s: float) -> bool:
    """Whether the two worlds part before that instant."""
    rows = max(1, min(len(other.t), int(np.searchsorted(one.t, until_s - 1e-9))))
    return bool(
        np.abs(one.pos[:rows] - other.pos[:rows]).max(initial=0.0) > 1e-12
        or np.abs(one.linvel[:rows] - other.linvel[:rows]).max(initial=0.0) > 1e-12
    )
