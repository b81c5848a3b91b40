"""Quaternions that are no rotations.

What it means: the recording was damaged, mixed up or written in another convention; every orientation, and whatever was
drawn from it, is wrong.

Formula: | |q| - 1 | of each row.
Threshold: 1e-3, a thousand times the error of single precision.
Source: a rotation is a unit quaternion.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign
from ..survey import survey

CODE = "WS131"
SHOWN_AS = "tilt"
NEEDS = ("quat",)
LIMIT = 1e-3


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each body with quaternions that are not unit."""
    if survey(trajectory).stretched.max(initial=0.0) <= LIMIT:
        return
    off = np.abs(np.sqrt(np.einsum("tbi,tbi->tb", trajectory.quat, trajectory.quat)) - 1.0)
    worst = off.max(axis=0)
    for b in np.flatnonzero(worst > LIMIT):
        rows = np.flatnonzero(off[:, b] > LIMIT)
        name = trajectory.names[b]
        message = f"the orientation of {name} is no rotation: its quaternion has length {1 + worst[b]:.4g}"
        window = (trajectory.t[rows[0]], trajectory.t[rows[-1]])
        yield Sign(name, window, worst[b], LIMIT, "of unit length", "blocking", message)


def _stretched() -> Case:
    still = analytic.resting()
    return Case("quaternions of length 1.2", replace(still, quat=1.2 * still.quat), severity="blocking")


GOOD = (lambda: Case("a rolling ball", analytic.rolling()),)
BAD = (_stretched,)
