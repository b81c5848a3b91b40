"""A body's recorded state stops changing, bit for bit, while it should go on.

What it means: the recorder (or the program) held the last value, or the motion was switched off. Real rest decays into
it and keeps the last digits moving; a velocity that does not move its body, or a motion that stops dead in mid-air, is
a frozen channel.

Formula: runs of rows whose position (or orientation) is exactly equal. Frozen if the recorded velocity would have
carried the body 0.05 r (or turned it 0.2 rad) meanwhile; or if velocity and pose freeze together for 0.1 s right after
a row with more than 0.1 sqrt(g r).
Threshold: exact equality needs no tolerance; the engine's own sleeping stops bodies only below about 1e-3 m/s.
Source: the reference paper's scanner.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS104"
REPAIR = "initial_motion"
NEEDS = ("linvel",)
HELD_S = 0.1


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies whose channels freeze, each once."""
    if len(trajectory.t) < 4:
        return
    dt = np.diff(trajectory.t)
    look = survey(trajectory)
    still, unturned = look.still.sum(axis=0), look.unturned.sum(axis=0)
    may = (still > 0) | (unturned * look.spin.max(axis=0) * dt.max() > 0.2)
    for b in np.flatnonzero(may & trajectory.moves_freely):
        same_place = np.all(trajectory.pos[1:, b] == trajectory.pos[:-1, b], axis=1)
        same_turn = np.all(trajectory.quat[1:, b] == trajectory.quat[:-1, b], axis=1)
        sign = _held(trajectory, b, same_place, trajectory.speed[:, b], dt, 0.05 * trajectory.size_m[b], "m")
        sign = sign or _held(trajectory, b, same_turn, trajectory.spin[:, b], dt, 0.2, "rad")
        sign = sign or _stopped_dead(trajectory, b, same_place & same_turn)
        if sign:
            yield sign


def _held(
    trajectory: Trajectory, b: int, same: np.ndarray, rate: np.ndarray, dt: np.ndarray, limit: float, unit: str
) -> Sign | None:
    """Find a pose that stands still although its velocity does not."""
    implied = np.where(same, np.minimum(rate[1:], rate[:-1]) * dt, 0.0)
    if implied.sum() < limit:
        return None
    total = np.concatenate(([0.0], np.cumsum(implied)))
    for start, stop in spans(same):
        amount = total[stop] - total[start]
        if stop - start >= 3 and amount > limit:
            name, what = trajectory.names[b], "position" if unit == "m" else "orientation"
            message = f"the {what} of {name} is held for {stop - start} rows while its velocity says it moves"
            return Sign(name, (trajectory.t[start], trajectory.t[stop]), amount, limit, unit, "blocking", message)
    return None


def _stopped_dead(trajectory: Trajectory, b: int, same: np.ndarray) -> Sign | None:
    """Find pose and velocity that freeze together, right after a row with real speed."""
    same = same & np.all(trajectory.linvel[1:, b] == trajectory.linvel[:-1, b], axis=1)
    limit = 0.1 * trajectory.speed_scale[b]
    rows = max(3, round(HELD_S / trajectory.interval_s))
    speed = trajectory.speed[:, b] + trajectory.spin[:, b] * trajectory.size_m[b] * 0.5
    for start, stop in spans(same):
        if stop - start < rows or start == 0 or speed[start - 1] < limit or speed[start] > 0.1 * speed[start - 1]:
            continue
        touching = trajectory.touching
        near = slice(max(0, start - 2), start + 2)
        hit = touching is not None and bool(touching[near, b].any())
        # Something may have stopped a body that touches, or of which nobody recorded whether it does.
        severity = "warn" if hit or touching is None else "blocking"
        name = trajectory.names[b]
        message = f"{name} stops dead{'' if hit or touching is None else ' without touching anything'} and is held"
        window = (trajectory.t[start], trajectory.t[stop])
        return Sign(name, window, speed[start - 1], limit, "m/s", severity, message)
    return None


def _held_pose() -> Case:
    slide = analytic.sliding()
    pos = slide.pos.copy()
    pos[500:] = pos[500]
    return Case("the last position is held while the velocity goes on", replace(slide, pos=pos), severity="blocking")


def _held_in_flight() -> Case:
    fall = analytic.falling()
    pos, vel = fall.pos.copy(), fall.linvel.copy()
    pos[200:], vel[200:] = pos[200], 0.0
    return Case("a falling body is switched off", replace(fall, pos=pos, linvel=vel), severity="blocking")


GOOD = (
    lambda: Case("a body at rest all along", analytic.resting()),
    lambda: Case("a body that is braked to a stop", analytic.sliding(1.0, 2.0)),
    lambda: Case("a ball rolling straight", analytic.rolling()),
)
BAD = (_held_pose, _held_in_flight)
