"""A body gets lower by at least so much.

Measures the largest drop of its origin below any earlier height: max over t of (max z before t) - z(t), metres.
Free fall from rest drops by g t^2 / 2. Source: kinematics.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, resting
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE103"
EVENT = True


class Given(OfBody):
    """The body, and the least drop."""

    min_m: float = Field(gt=0, description="least drop, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the deepest drop."""
    height = trajectory.pos[window(trajectory, given.window_s), body_index(trajectory, given.body), 2]
    drop = float((np.maximum.accumulate(height) - height).max())
    return at_least(drop, given.min_m, "m", f"{given.body} drops by {drop:.3f} m")


GOOD = ((lambda: falling(seconds=0.5), {"body": "body", "min_m": 1.2}),)
BAD = ((lambda: falling(seconds=0.5), {"body": "body", "min_m": 1.3}), (resting, {"body": "body", "min_m": 0.01}))
