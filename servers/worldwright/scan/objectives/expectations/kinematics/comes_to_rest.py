"""Bodies are at rest from some moment on.

At rest: the speed of the origin plus the rim speed (angular speed times the body's radius) stays under `max_speed_m_s`
from `before_s` to the end. Source: kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....measuring.measured import Measured, OfBodies, UnknowableError, at_most

CODE = "WE108"
RESTS = True
EVENT = True


class Given(OfBodies):
    """The bodies, the time by which they rest, and the speed that counts as rest."""

    before_s: float = Field(gt=0, description="from when on it is at rest, s")
    max_speed_m_s: float = Field(default=0.02, gt=0, description="what still counts as rest, m/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the fastest that any of them still is."""
    bodies = given.indices(trajectory)
    end = given.window_s[1] if given.window_s else None
    if trajectory.t[-1] < given.before_s or (end is not None and end < given.before_s):
        last = min(float(trajectory.t[-1]), end if end is not None else float("inf"))
        raise UnknowableError(f"what is judged ends at {last:.3f} s, before {given.before_s:g} s")
    rows = trajectory.rows(given.before_s, end)
    fast = (trajectory.speed + trajectory.spin * trajectory.size_m)[rows][:, bodies]
    worst = int(fast.max(axis=0).argmax())
    top = float(fast.max())
    message = f"after {given.before_s:g} s the fastest is {given.names[worst]} at {top:.4f} m/s"
    return at_most(top, given.max_speed_m_s, "m/s", message)


GOOD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "before_s": 1.2}),
    (resting, {"bodies": ["body"], "before_s": 0.1}),
)
BAD = ((lambda: sliding(1.0, 0.4), {"body": "body", "before_s": 1.2}),)
