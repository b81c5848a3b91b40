"""A body gets higher by at least so much.

Measures the largest rise of its origin above any earlier height: max over t of z(t) - (min z before t), metres.
Thrown upwards at v it rises by v^2 / (2 g). Source: kinematics.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling
from ....known.motions import thrown
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE120"
EVENT = True


class Given(OfBody):
    """The body, and the least rise."""

    min_m: float = Field(gt=0, description="least rise, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the highest rise."""
    rows = window(trajectory, given.window_s)
    height = trajectory.pos[rows, body_index(trajectory, given.body), 2]
    rises = height - np.minimum.accumulate(height)
    rise, reached = float(rises.max()), rises >= given.min_m
    when = f", by {given.min_m:g} m at {trajectory.t[rows][int(reached.argmax())]:.3f} s" if reached.any() else ""
    return at_least(rise, given.min_m, "m", f"{given.body} rises by {rise:.3f} m{when}")


GOOD = ((lambda: thrown((0, 0, 3.0)), {"body": "body", "min_m": 0.458}),)  # 3^2 / 2 g = 0.4589 m
BAD = (
    (lambda: thrown((0, 0, 3.0)), {"body": "body", "min_m": 0.46}),
    (falling, {"body": "body", "min_m": 0.001}),
)
