"""A falling (or rising) body stops getting faster: drag balances weight.

Measures the speed over the last `for_s` of the window, m/s; there it may vary by at most `tolerance`, and with `m_s` it
must agree. At the start of the window the body must have been slower. Source: Stokes' law, v = 2 (ro - ro') g r^2 /
(9 eta); quadratic drag, v = sqrt(2 m g / (ro' Cd A)).
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, sliding
from ....known.motions import drifting
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_most, body_index, close_to, last_rows, window

CODE = "WE263"
EVENT = True
SLOWER = 0.9


class Given(OfBody):
    """The body, the speed to expect, and how steady it must be."""

    m_s: float | None = Field(None, gt=0, description="expected terminal speed, m/s")
    tolerance: Tolerance = Field(0.05, description="relative, of the speed and of its change")
    for_s: float = Field(default=0.2, gt=0, description="the time at the end that is judged, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the speed in the end."""
    rows = window(trajectory, given.window_s, 3)
    body = body_index(trajectory, given.body)
    late = trajectory.speed[last_rows(trajectory, rows, given.for_s), body]
    mean, start = float(late.mean()), float(trajectory.speed[rows.start, body])
    varies = float(np.ptp(late) / mean) if mean > 0 else 1.0
    message = f"{given.body} goes from {start:.3f} m/s to {mean:.4f} m/s, which still varies by {varies:.2%}"
    conditions = [
        at_most(varies, given.tolerance, "1", message),
        at_most(start, SLOWER * mean, "m/s", f"{message}: it was as fast at the start"),
    ]
    if given.m_s is not None:
        conditions.insert(0, close_to(mean, given.m_s, given.tolerance, "m/s", message))
    return all_of(*conditions)


GOOD = ((lambda: drifting(2.0), {"body": "body", "m_s": 2.0, "tolerance": 0.01}),)
BAD = (
    (lambda: drifting(2.0), {"body": "body", "m_s": 3.0}),
    (falling, {"body": "body"}),
    (sliding, {"body": "body"}),
)
