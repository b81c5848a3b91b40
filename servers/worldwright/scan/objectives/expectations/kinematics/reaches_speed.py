"""A body is at least so fast at some moment.

Measures the largest speed of its origin in the window, m/s. Free fall from rest over a height h gives sqrt(2 g h).
Source: kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE104"
EVENT = True


class Given(OfBody):
    """The body, and the speed to reach."""

    min_m_s: float = Field(gt=0, description="least top speed, m/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the top speed."""
    top = float(trajectory.speed[window(trajectory, given.window_s), body_index(trajectory, given.body)].max())
    return at_least(top, given.min_m_s, "m/s", f"{given.body} reaches {top:.3f} m/s")


GOOD = ((lambda: falling(seconds=0.5), {"body": "body", "min_m_s": 4.8}),)
BAD = ((lambda: falling(seconds=0.5), {"body": "body", "min_m_s": 5.0}),)
