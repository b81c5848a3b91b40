"""A ball or wheel rolls without slipping.

The contact point of a body of radius r is at rest when v = omega x r, with r pointing from the ground to the centre:
slip = |v_horizontal - (omega x r z)| / |v|. Measures the mean slip over the rows after `after_s` in which it moves.
Source: rigid-body kinematics, rolling constraint.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import rolling
from ....measuring.measured import Measured, OfBody, Tolerance, UnknowableError, at_most, body_index, window

CODE = "WE110"
LASTING = True


class Given(OfBody):
    """The body, its radius, and the slip that is allowed."""

    radius_m: float = Field(gt=0, description="from its centre to the ground, m")
    tolerance: Tolerance = Field(description="allowed slip, relative to its speed")
    after_s: float = Field(default=0.0, ge=0, description="when rolling must have set in, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the mean relative slip."""
    body = body_index(trajectory, given.body)
    whole = window(trajectory, given.window_s)
    start = int(trajectory.t.searchsorted(given.after_s - 1e-9))
    rows = slice(max(whole.start, start), whole.stop)
    if rows.start >= rows.stop:
        raise UnknowableError(f"the recording ends before {given.after_s:g} s")
    v, omega = trajectory.linvel[rows, body, :2], trajectory.angvel[rows, body]
    rim = np.stack([omega[:, 1], -omega[:, 0]], axis=1) * given.radius_m
    speed = np.linalg.norm(v, axis=1)
    moving = speed > 0.02 * max(float(trajectory.speed[:, body].max()), 1e-9)
    if not moving.any():
        raise UnknowableError(f"{given.body} does not move after {given.after_s:g} s")
    slip = float((np.linalg.norm(v - rim, axis=1)[moving] / speed[moving]).mean())
    message = f"{given.body} slips by {slip:.2%} of its speed"
    return at_most(slip, given.tolerance, "1", message)


GOOD = ((lambda: rolling(1.0, 0.1), {"body": "ball", "radius_m": 0.1, "tolerance": 0.01}),)
BAD = ((lambda: rolling(1.0, 0.1, slip=0.3), {"body": "ball", "radius_m": 0.1, "tolerance": 0.1}),)
