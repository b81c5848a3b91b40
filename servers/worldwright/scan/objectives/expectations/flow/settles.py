"""A crowd of bodies settles: from some moment on nearly all of them are at rest.

Measures the share of them that stay under `max_speed_m_s` from `before_s` to the end of the window.
Source: kinematics; granular media.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd
from ....measuring.channels import OfParts, group
from ....measuring.measured import Measured, UnknowableError, at_least, window

CODE = "WE265"
EVENT = True


class Given(OfParts):
    """The crowd, the time by which it rests, and the share that must."""

    before_s: float = Field(gt=0, description="from when on they are at rest, s")
    min_share: float = Field(default=0.95, gt=0, le=1, description="least share of them that is at rest")
    max_speed_m_s: float = Field(default=0.02, gt=0, description="what still counts as rest, m/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share at rest."""
    rows = window(trajectory, given.window_s)
    start = int(trajectory.t.searchsorted(given.before_s - 1e-9))
    if start >= rows.stop:
        last = float(trajectory.t[rows.stop - 1])
        raise UnknowableError(f"what is judged ends at {last:.3f} s, before {given.before_s:g} s")
    top = trajectory.speed[max(start, rows.start) : rows.stop][:, group(trajectory, given.parts)].max(axis=0)
    share = float((top <= given.max_speed_m_s).mean())
    message = f"after {given.before_s:g} s {share:.1%} of {given.told()} is at rest, the fastest at {top.max():.3f} m/s"
    return at_least(share, given.min_share, "1", message)


GOOD = ((crowd, {"parts": "grain_*", "before_s": 1.1}),)
BAD = ((lambda: crowd(until=2.0), {"parts": "grain_*", "before_s": 1.1}),)
