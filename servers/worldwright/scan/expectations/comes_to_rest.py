"""Bodies are at rest from some moment on.

At rest: the speed of the origin plus the rim speed (angular speed times the body's radius) stays under `max_speed_m_s`
from `before_s` to the end. Source: kinematics.
"""

from pydantic import Field

from ...model.trajectory import Trajectory
from ..analytic import resting, sliding
from ..measured import Measured, OfBodies, UnknowableError, body_index

CODE = "WE108"


class Given(OfBodies):
    """before_s: by when; max_speed_m_s: what still counts as rest."""

    before_s: float = Field(gt=0)
    max_speed_m_s: float = Field(default=0.02, gt=0)


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The fastest that any of them still is."""
    if not given.names:
        raise UnknowableError("name a body or bodies")
    if trajectory.t[-1] < given.before_s:
        raise UnknowableError(f"the recording ends at {trajectory.t[-1]:.3f} s, before {given.before_s:g} s")
    bodies = [body_index(trajectory, name) for name in given.names]
    rows = trajectory.rows(given.before_s, None)
    fast = (trajectory.speed + trajectory.spin * trajectory.size_m)[rows][:, bodies]
    worst = int(fast.max(axis=0).argmax())
    top = float(fast.max())
    message = f"after {given.before_s:g} s the fastest is {given.names[worst]} at {top:.4f} m/s"
    margin = given.max_speed_m_s - top
    return Measured(top, f"at most {given.max_speed_m_s:g} m/s", margin, "m/s", message)


GOOD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "before_s": 1.2}),
    (resting, {"bodies": ["body"], "before_s": 0.1}),
)
BAD = ((lambda: sliding(1.0, 0.4), {"body": "body", "before_s": 1.2}),)
