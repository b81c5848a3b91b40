"""One body takes longer than another: to come to rest, to hit something, to swing once.

Measures the ratio of their times, `body` over `other`, counted from the start of the window. A fall from four times the
height takes twice as long; a pendulum four times as long swings half as fast. Source: kinematics.
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import swinging
from ....known.motions import two
from ....measuring.measured import Measured, Name, OfBody, at_least, body_index, window
from ...quantities import TIMES

CODE = "WE284"


class Given(OfBody):
    """The two bodies, what is timed, and the ratio to reach."""

    other: Name = Field(description="the quicker body")
    of: Literal["rest_time", "contact_time", "period"] = Field(
        description="until at rest, until it touches, or a swing"
    )
    min_ratio: float = Field(default=1.000001, gt=1, description="least ratio, longer over shorter")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the ratio of the times."""
    rows = window(trajectory, given.window_s)
    _, of = TIMES[given.of]
    one, other = (of(trajectory, body_index(trajectory, name), rows) for name in (given.body, given.other))
    message = f"{given.of.replace('_', ' ')} of {given.body} is {one:.4f} s, of {given.other} {other:.4f} s"
    ratio = one / other if other > 0 else (1e9 if one > 0 else 1.0)
    return at_least(ratio, given.min_ratio, "1", message)


def pendulums() -> Trajectory:
    """`a` of 1 m, `b` of 0.25 m."""
    return two(swinging(1.0, 5.0, seconds=6), swinging(0.25, 5.0, seconds=6))


GOOD = ((pendulums, {"body": "a", "other": "b", "of": "period", "min_ratio": 1.99}),)
BAD = (
    (pendulums, {"body": "a", "other": "b", "of": "period", "min_ratio": 2.05}),
    (pendulums, {"body": "b", "other": "a", "of": "period"}),
)
