"""A body keeps its tilt: its own z axis stays within some degrees of where it pointed at the start.

Measures the largest angle between its z axis and that at the first row; turning about the vertical does not count.
Source: rigid-body kinematics.
"""

import numpy as np
from pydantic import Field

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.analytic import tilting
from ....measuring.measured import Measured, OfBody, body_index, window

CODE = "WE112"
LASTING = True


class Given(OfBody):
    """The body, and the largest tilt."""

    max_tilt_deg: float = Field(gt=0, lt=180, description="largest tilt allowed, deg")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest tilt."""
    quat = trajectory.quat[window(trajectory, given.window_s), body_index(trajectory, given.body)]
    axis = matrices(quat)[:, :, 2]
    tilt = float(np.degrees(np.arccos(np.clip(axis @ axis[0], -1, 1)).max()))
    message = f"{given.body} tilts by {tilt:.2f} degrees"
    return Measured(tilt, f"at most {given.max_tilt_deg:g} deg", given.max_tilt_deg - tilt, "deg", message)


GOOD = ((lambda: tilting(5.0), {"body": "body", "max_tilt_deg": 6}),)
BAD = ((lambda: tilting(45.0), {"body": "body", "max_tilt_deg": 30}),)
