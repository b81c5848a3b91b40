"""A body turns by at least so much.

Measures the angle passed: the integral of the angular speed, or of its component about `axis` of the world (then
turning back counts back, and the largest value either way is taken), degrees. Source: rotational kinematics.
"""

from typing import Literal

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.rotation import spinning
from ....measuring.channels import AXES
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE163"
EVENT = True


class Given(OfBody):
    """The body, the axis, and the angle to reach."""

    min_deg: float = Field(gt=0, description="least angle passed, deg")
    axis: Literal["x", "y", "z"] | None = Field(None, description="axis of the world; without it any turning counts")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the angle passed."""
    rows = window(trajectory, given.window_s, 2)
    body, t = body_index(trajectory, given.body), trajectory.t[rows]
    rate = trajectory.angvel[rows, body, AXES[given.axis]] if given.axis else trajectory.spin[rows, body]
    angle = np.degrees(np.abs(np.cumsum((rate[1:] + rate[:-1]) / 2 * np.diff(t))).max())
    about = f" about {given.axis}" if given.axis else ""
    return at_least(float(angle), given.min_deg, "deg", f"{given.body} turns by {angle:.1f} degrees{about}")


GOOD = ((lambda: spinning(np.pi, seconds=2.0), {"body": "body", "min_deg": 359.9, "axis": "z"}),)
BAD = (
    (lambda: spinning(np.pi, seconds=2.0), {"body": "body", "min_deg": 361}),
    (lambda: spinning(np.pi, seconds=2.0), {"body": "body", "min_deg": 5, "axis": "x"}),
    (resting, {"body": "body", "min_deg": 0.1}),
)
