"""A resting body sinks slowly and steadily into what carries it.

What it means: the contact is too soft, too damped or missing, or the pose is written; a body that should rest creeps
through its support. A ball rolling down a slope and a lift going down sink too, but not into anything.

Formula: over runs of at least 1 s in which z falls at every tenth of a second, slower than 0.3 sqrt(g r), and mostly
straight down (sideways less than 0.3 of the drop). With contacts: it touches for 80 % of the run and the penetration
depth grows by 0.4 of the drop. Without: the drop alone exceeds half of r, which is only worth a warning.
Threshold: 0.05 r warns; half of the body's half-thickness blocks, since by then it is visibly inside its support.
Source: the reference paper's scanner; the manual on soft contacts (a static load gives a constant depth).
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans

CODE = "WS105"
RELATIVE = True
SHOWN_AS = "height"
NEEDS = ("pos",)
SAMPLE_S = 0.1
RUN_S = 1.0


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies that sink, each with its longest run."""
    stride = max(1, round(SAMPLE_S / trajectory.interval_s))
    rows = np.arange(0, len(trajectory.t), stride)
    needed = round(RUN_S / (stride * trajectory.interval_s))
    if len(rows) <= needed:
        return
    size, scale = trajectory.size_m, trajectory.speed_scale
    pos = trajectory.pos[rows]
    drop = -np.diff(pos[:, :, 2], axis=0)
    every = np.diff(trajectory.t[rows])[:, None]
    slow = (drop > 1e-4 * size) & (drop < 0.3 * scale * every)
    for b in np.flatnonzero(slow.any(axis=0) & trajectory.moves_freely):
        runs = [run for run in spans(slow[:, b]) if run[1] - run[0] >= needed]
        if not runs:
            continue
        start, stop = max(runs, key=lambda run: run[1] - run[0])
        fallen = float(pos[start, b, 2] - pos[stop, b, 2])
        sideways = float(np.sqrt(((pos[stop, b, :2] - pos[start, b, :2]) ** 2).sum()))
        if sideways > 0.3 * fallen:
            continue
        yield from _judge(trajectory, context, b, rows[start], rows[stop], fallen)


def _judge(trajectory: Trajectory, context: Context, b: int, start: int, stop: int, fallen: float) -> Iterator[Sign]:
    name, size = trajectory.names[b], trajectory.size_m[b]
    window = (trajectory.t[start], trajectory.t[stop])
    depth = _depth(trajectory, b)
    touching = trajectory.touching
    if depth is not None and touching is not None:
        deeper = float(depth[stop] - depth[start])
        if touching[start : stop + 1, b].mean() < 0.8 or deeper < 0.4 * fallen:
            return
        if fallen > 0.05 * size:
            half = trajectory.mechanics.half_thickness()
            limit = 0.5 * (size if half is None or np.isnan(half[b]) else half[b])
            severity = "blocking" if depth[stop] > limit else "warn"
            message = f"{name} sinks {fallen:.3g} m into its support, to a depth of {depth[stop]:.3g} m"
            yield Sign(name, window, fallen, 0.05 * size, "m", severity, message)
    elif fallen > 0.5 * size:
        severity = "blocking" if name in context.rests or name in context.fixed else "warn"
        message = f"{name} goes down {fallen:.3g} m, slowly and steadily"
        yield Sign(name, window, fallen, 0.5 * size, "m", severity, message)


def _depth(trajectory: Trajectory, b: int) -> np.ndarray | None:
    """(T,) m: how deep a body is in others; the deepest of the whole system where nothing else was recorded."""
    if trajectory.depth_m is not None:
        return trajectory.depth_m[:, b]
    return trajectory.max_penetration


def _sinking() -> Case:
    still = analytic.resting(3.0)
    pos, speed = still.pos.copy(), still.linvel.copy()
    pos[:, 0, 2] -= 0.02 * still.t
    speed[:, 0, 2] = -0.02
    assert still.contacts is not None
    touch = replace(still.contacts, depth_m=0.02 * still.t)
    sinking = replace(still, pos=pos, linvel=speed, contacts=touch)
    return Case("a box sinks into the floor", sinking, severity="blocking")


def _poses_alone() -> Case:
    sinking = _sinking().trajectory
    return Case("the same, without contacts", replace(sinking, contacts=None), severity="warn")


def _lift() -> Case:
    sinking = _sinking().trajectory
    assert sinking.contacts is not None
    touch = replace(sinking.contacts, depth_m=np.full(len(sinking.t), 1e-4))
    return Case("a lift goes down", replace(sinking, contacts=touch))


def _slope() -> Case:
    slide = analytic.sliding(0.2, seconds=3.0)
    pos = slide.pos.copy()
    pos[:, 0, 2] -= 0.1 * slide.t
    slope = replace(slide.mechanics, ground_z=None)
    return Case("a body slides slowly down a slope", replace(slide, pos=pos, mechanics=slope))


GOOD = (
    lambda: Case("a body at rest", analytic.resting(3.0)),
    lambda: Case("free fall", analytic.falling()),
    _lift,
    _slope,
)
BAD = (_sinking, _poses_alone)
