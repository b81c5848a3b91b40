"""A recorded value is not a number, or is infinite.

What it means: the solver diverged (a step too large for a stiffness, an inertia of nearly zero, a body starting deep
inside another), and everything after the first such row is meaningless.

Formula: not isfinite(x) for any of position, orientation, velocity or energy; also an orientation whose norm is not 1.
Threshold: none for nan; a quaternion's norm may stray by 1e-3, far beyond rounding and far below anything intended.
Source: the reference paper's scanner; IEEE 754.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS101"
UNCUT = True
NEEDS = ("pos",)
NORM_TOLERANCE = 1e-3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies (or the system) whose numbers are not."""
    channels = (trajectory.pos, trajectory.quat, trajectory.linvel, trajectory.angvel)
    bad = np.zeros(trajectory.pos.shape[:2], dtype=bool)
    if not trajectory.finite:
        for channel in channels:
            bad |= ~np.isfinite(channel).all(axis=2)
    yield from _signs(trajectory, bad, trajectory.names, "is not a number")
    if trajectory.energy is not None:
        odd = ~np.isfinite(trajectory.energy).all(axis=1)[:, None]
        yield from _signs(trajectory, odd, ("energy",), "is not a number")
    stretched = survey(trajectory).stretched
    if not (stretched > 2 * NORM_TOLERANCE).any() and not np.isnan(stretched).any():
        return
    norm = np.einsum("tbi,tbi->tb", trajectory.quat, trajectory.quat)
    off = ~bad & (np.abs(norm - 1) > 2 * NORM_TOLERANCE)
    yield from _signs(trajectory, off, trajectory.names, "has an orientation that is no rotation (its norm is not 1)")


def _signs(trajectory: Trajectory, bad: np.ndarray, names: tuple[str, ...], what: str) -> Iterator[Sign]:
    for b in np.flatnonzero(bad.any(axis=0)):
        rows = np.flatnonzero(bad[:, b])
        window = (trajectory.t[rows[0]], trajectory.t[rows[-1]])
        yield Sign(names[b], window, len(rows), 0, "rows", "blocking", f"the state of {names[b]} {what}")


def _diverged() -> Case:
    still = analytic.resting()
    pos = still.pos.copy()
    pos[500:] = np.nan
    return Case("positions turn into nan half way", replace(still, pos=pos), severity="blocking")


def _infinite_speed() -> Case:
    still = analytic.resting()
    speed = still.linvel.copy()
    speed[700, 0, 2] = np.inf
    return Case("one infinite velocity", replace(still, linvel=speed), severity="blocking")


def _stretched() -> Case:
    still = analytic.resting()
    return Case("quaternions of norm two", replace(still, quat=2 * still.quat), severity="blocking")


GOOD = (lambda: Case("a body at rest", analytic.resting()),)
BAD = (_diverged, _infinite_speed, _stretched)
