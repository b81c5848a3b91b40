"""A body gets higher by at least so much.

Measures the largest rise of its origin above any earlier height: max over t of z(t) - (min z before t), metres.
Thrown upwards at v it rises by v^2 / (2 g). Source: kinematics.
"""

import numpy as np
from pydantic import Field

from ....model.trajectory import Trajectory
from ...analytic import falling
from ...known.motions import thrown
from ...measured import Measured, OfBody, at_least, body_index, window

CODE = "WE120"
EVENT = True


class Given(OfBody):
    """The least rise."""

    min_m: float = Field(gt=0, description="least rise, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The highest rise."""
    height = trajectory.pos[window(trajectory, given.window_s), body_index(trajectory, given.body), 2]
    rise = float((height - np.minimum.accumulate(height)).max())
    return at_least(rise, given.min_m, "m", f"{given.body} rises by {rise:.3f} m")


GOOD = ((lambda: thrown((0, 0, 3.0)), {"body": "body", "min_m": 0.458}),)  # 3^2 / 2 g = 0.4589 m
BAD = (
    (lambda: thrown((0, 0, 3.0)), {"body": "body", "min_m": 0.46}),
    (falling, {"body": "body", "min_m": 0.001}),
)
