"""A body keeps turning about the same axis, as a gyroscope does.

Measures the largest angle between its angular velocity and the mean of it over the window, degrees. Torque-free
rotation about a principal axis of the largest or smallest inertia is stable. Source: Euler's equations; conservation of
angular momentum.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.rotation import precessing, spinning
from ....measuring.measured import Measured, OfBody, at_most, body_index, window

CODE = "WE166"
LASTING = True
STILL_RAD_S = 1e-6


class Given(OfBody):
    """The body, and the tolerance."""

    max_angle_deg: float = Field(gt=0, lt=180, description="largest angle off the mean axis, deg")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest angle."""
    rate = trajectory.angvel[window(trajectory, given.window_s, 2), body_index(trajectory, given.body)]
    size, mean = np.linalg.norm(rate, axis=1), rate.mean(axis=0)
    if size.min() < STILL_RAD_S or np.linalg.norm(mean) < STILL_RAD_S:
        return at_most(180.0, given.max_angle_deg, "deg", f"{given.body} does not keep turning")
    cosine = rate @ mean / (size * np.linalg.norm(mean))
    angle = float(np.degrees(np.arccos(np.clip(cosine, -1, 1)).max()))
    return at_most(angle, given.max_angle_deg, "deg", f"the axis of {given.body} strays by {angle:.2f} degrees")


GOOD = ((spinning, {"body": "body", "max_angle_deg": 0.1}),)
BAD = ((precessing, {"body": "body", "max_angle_deg": 20}), (resting, {"body": "body", "max_angle_deg": 20}))
