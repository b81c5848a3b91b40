"""A body turns otherwise than its recorded angular velocity says.

What it means: degrees written as radians, a spin in another frame, a stale or missing channel, or orientations that were
edited or put in another order.

Formula: the orientation of each row, turned by the mean of the two angular velocities for the step, against the next
orientation; the angle between them, where it exceeds 2 mrad and a third of the larger of the two turns. Rows whose spin
changes by more than half over the step, or that turn by more than 2 rad in truth, are not judged.
Threshold: such rows for 0.1 s and at least five, 0.3 rad in all: the quadrature of a step is far better.
Source: the definition of angular velocity.
"""

from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from worldkit.turning import about, angles_between, product

from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign, spans
from ..survey import survey

CODE = "WS138"
NEEDS = ("angvel", "quat")
ANGLE, STEP, SHARE, HELD_S, ROWS = 0.3, 0.002, 1 / 3, 0.1, 5
SLOW = 0.005
"""A body whose turns and spins stay below this, rad in a step, is not looked at row by row."""


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the bodies whose turning and spin do not agree."""
    if len(trajectory.t) <= ROWS:
        return
    dt = np.diff(trajectory.t)
    look = survey(trajectory)
    posed = trajectory.mechanics.mocap
    fast = look.spin.max(axis=0) * float(dt.max()) > SLOW
    fast |= (look.overturn > SLOW).any(axis=0)
    for b in np.flatnonzero(fast & np.any(trajectory.angvel != 0, axis=(0, 2))):
        if posed is not None and posed[b]:
            continue
        quat, spin = trajectory.quat[:, b], trajectory.angvel[:, b]
        said = (spin[1:] + spin[:-1]) / 2 * dt[:, None]
        size = np.sqrt((said**2).sum(axis=1))
        made = product(about(said / np.maximum(size, 1e-12)[:, None], size), quat[:-1])
        off, turned = angles_between(quat[1:], made), angles_between(quat[1:], quat[:-1])
        change = np.sqrt((np.diff(spin, axis=0) ** 2).sum(axis=1)) * dt
        wrong = (off > STEP) & (off > SHARE * np.maximum(turned, np.minimum(size, np.pi)))
        wrong &= (change < 0.5 * size + 1e-9) & (turned < 2.0)
        rows = max(ROWS, round(HELD_S / trajectory.interval_s))
        for start, stop in spans(wrong, bridge=1):
            if stop - start >= rows and off[start:stop].sum() > ANGLE:
                name, rate = trajectory.names[b], float(np.median(turned[start:stop] / dt[start:stop]))
                told = float(np.median(trajectory.spin[start:stop, b]))
                message = f"{name} turns at {rate:.3g} rad/s by its orientations, and at {told:.3g} rad/s by its angular velocity"
                window = (trajectory.t[start], trajectory.t[stop])
                yield Sign(name, window, float(off[start:stop].sum()), ANGLE, "rad", "blocking", message)
                break


def _turning(factor: float) -> Trajectory:
    made = analytic.resting(1.0, dt=0.01)
    angle = 3.0 * made.t
    quat = np.zeros((len(angle), 1, 4))
    quat[:, 0, 0], quat[:, 0, 3] = np.cos(angle / 2), np.sin(angle / 2)
    spin = np.zeros_like(made.angvel)
    spin[:, 0, 2] = 3.0 * factor
    return replace(made, quat=quat, angvel=spin)


GOOD = (
    lambda: Case("a body that turns", _turning(1.0)),
    lambda: Case("a ball rolling straight", analytic.rolling()),
)
BAD = (lambda: Case("degrees for radians", _turning(180 / np.pi), severity="blocking"),)
