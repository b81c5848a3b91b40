"""A body keeps its speed.

Measures the largest change of the speed of its origin over the window, relative to the mean speed. Uniform motion on
a line or a circle has none. Source: Newton's first law; uniform circular motion.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....known.motions import circling
from ....measuring.measured import Measured, OfBody, Tolerance, at_most, body_index, window

CODE = "WE127"
LASTING = True
STILL_M_S = 1e-6


class Given(OfBody):
    """The body, and the tolerance."""

    tolerance: Tolerance = Field(description="largest change, relative to the mean speed")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative change."""
    speed = trajectory.speed[window(trajectory, given.window_s, 2), body_index(trajectory, given.body)]
    mean = float(speed.mean())
    if mean < STILL_M_S:
        return at_most(1.0, min(given.tolerance, 0.999), "1", f"{given.body} stands still: it has no speed to keep")
    share = float(np.abs(speed - mean).max() / mean)
    return at_most(share, given.tolerance, "1", f"{given.body} keeps {mean:.4f} m/s within {share:.2%}")


GOOD = (
    (lambda: sliding(1.0), {"body": "body", "tolerance": 0.001}),
    (lambda: circling(0.5, 3.0), {"body": "body", "tolerance": 0.001}),
)
BAD = ((lambda: sliding(1.0, 0.4), {"body": "body", "tolerance": 0.2}), (resting, {"body": "body", "tolerance": 0.2}))
