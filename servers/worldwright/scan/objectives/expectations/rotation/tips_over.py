"""A body tips over.

Measures the largest angle between the body's own z axis and where it pointed at the start of the window, degrees;
turning about the vertical does not count. As an event it comes at the first recorded row at which that angle is reached. A block tips when its centre of mass passes its edge, at atan(width / height).
Source: rigid-body statics.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, tilting
from ....known.rotation import spinning
from ....measuring.channels import direction_of
from ....measuring.measured import Measured, OfBody, at_least

CODE = "WE162"
EVENT = True


class Given(OfBody):
    """The body, and the tilt to reach."""

    min_tilt_deg: float = Field(default=60.0, gt=0, lt=180, description="least tilt, deg")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest tilt."""
    axis = direction_of(trajectory, given, "z")
    tilt = float(np.degrees(np.arccos(np.clip(axis @ axis[0], -1, 1)).max()))
    return at_least(tilt, given.min_tilt_deg, "deg", f"{given.body} tips by {tilt:.2f} degrees")


GOOD = ((lambda: tilting(90.0), {"body": "body", "min_tilt_deg": 89}),)
BAD = (
    (lambda: tilting(45.0), {"body": "body"}),
    (spinning, {"body": "body", "min_tilt_deg": 1}),
    (resting, {"body": "body", "min_tilt_deg": 1}),
)
