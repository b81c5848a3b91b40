"""A body spins at least so fast at some moment.

Measures the largest angular speed in the window, rad/s. A ball that rolls at v has v / r. Source: rotational kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, rolling
from ....known.motions import downhill
from ....measuring.measured import Measured, OfBody, at_least, body_index, window

CODE = "WE164"
EVENT = True


class Given(OfBody):
    """The body, and the rate to reach."""

    min_rad_s: float = Field(gt=0, description="least top angular speed, rad/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the top rate."""
    top = float(trajectory.spin[window(trajectory, given.window_s), body_index(trajectory, given.body)].max())
    return at_least(top, given.min_rad_s, "rad/s", f"{given.body} spins at up to {top:.3f} rad/s")


GOOD = (
    (lambda: rolling(1.0, 0.1), {"body": "ball", "min_rad_s": 9.99}),
    (lambda: downhill(30.0, rolls=True), {"body": "body", "min_rad_s": 70.0}),  # 5/7 g sin / r = 70.05 rad/s^2
)
BAD = (
    (lambda: rolling(1.0, 0.1), {"body": "ball", "min_rad_s": 10.1}),
    (resting, {"body": "body", "min_rad_s": 0.01}),
)
