"""A body gets at least so far from where it starts.

Measures the largest distance of its origin from its first position in the window: max |x(t) - x(0)|, metres.
Source: kinematics, displacement.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE101"
EVENT = True


class Given(OfBody):
    """The body, and the least distance."""

    min_m: float = Field(gt=0, description="least distance, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the farthest it gets."""
    path = trajectory.pos[window(trajectory, given.window_s), body_index(trajectory, given.body)]
    far = float(np.linalg.norm(path - path[0], axis=1).max())
    return at_least(far, given.min_m, "m", f"{given.body} gets {far:.3f} m away")


GOOD = ((lambda: sliding(1.0, seconds=2.0), {"body": "body", "min_m": 1.9}),)
BAD = ((lambda: sliding(1.0, seconds=2.0), {"body": "body", "min_m": 2.1}), (resting, {"body": "body", "min_m": 0.01}))
