"""Bodies never get faster than so much.

Measures the largest speed of the origin of any of them in the window, m/s. Source: kinematics; for what falls over a
height h without a motor, conservation of energy bounds the speed by sqrt(v0^2 + 2 g h).
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling
from ....measuring.measured import Measured, OfBodies, at_most, window

CODE = "WE133"
LASTING = True


class Given(OfBodies):
    """The bodies, and the largest speed."""

    max_m_s: float = Field(gt=0, description="largest speed allowed, m/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the top speed of all."""
    speed = trajectory.speed[window(trajectory, given.window_s)][:, given.indices(trajectory)]
    name = given.names[int(speed.max(axis=0).argmax())]
    top = float(speed.max())
    return at_most(top, given.max_m_s, "m/s", f"the fastest is {name} at {top:.3f} m/s")


GOOD = ((lambda: falling(seconds=0.5), {"body": "body", "max_m_s": 4.91}),)
BAD = ((lambda: falling(seconds=0.5), {"bodies": ["body"], "max_m_s": 4.9}),)
