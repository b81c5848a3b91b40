"""A body stays where it is.

Measures the largest distance of its origin from its first position in the window, metres. A body that turns on the
spot stays; ask `stays_upright` about its tilt. Up to the end it also asks for rest (`WS107`): of what a wind still moves
then, claim `stays_within`. Source: kinematics, displacement.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....measuring.measured import Measured, OfBody, at_most, body_index, window

CODE = "WE102"
RESTS = True
LASTING = True


class Given(OfBody):
    """The body, and the largest distance."""

    max_m: float = Field(gt=0, description="largest distance allowed, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the farthest it gets."""
    path = trajectory.pos[window(trajectory, given.window_s), body_index(trajectory, given.body)]
    far = float(np.linalg.norm(path - path[0], axis=1).max())
    return at_most(far, given.max_m, "m", f"{given.body} gets {far * 1000:.2f} mm away from where it starts")


GOOD = ((resting, {"body": "body", "max_m": 0.001}),)
BAD = ((lambda: sliding(1.0), {"body": "body", "max_m": 0.5}),)
