"""A body covers at least so long a way, however it winds.

Measures the length of the path of its origin: the sum of |dx|, metres. A pendulum travels though it returns.
Source: kinematics, arc length.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.motions import circling
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE129"
EVENT = True


class Given(OfBody):
    """The body, and the least length of its path."""

    min_m: float = Field(gt=0, description="least length of the path, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the length of the path."""
    path = trajectory.pos[window(trajectory, given.window_s), body_index(trajectory, given.body)]
    length = float(np.linalg.norm(np.diff(path, axis=0), axis=1).sum())
    return at_least(length, given.min_m, "m", f"{given.body} travels {length:.3f} m")


GOOD = ((lambda: circling(1.0, 2.0, turns=1), {"body": "body", "min_m": 6.28}),)  # 2 pi r
BAD = (
    (lambda: circling(1.0, 2.0, turns=1), {"body": "body", "min_m": 6.3}),
    (resting, {"body": "body", "min_m": 0.001}),
)
