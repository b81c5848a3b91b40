"""One body is higher than another, or gets higher.

Measures the difference of their heights, `body` less `other`, metres: the highest or lowest points of the window, the
last ones, or how far each rises or drops. A ball thrown up twice as fast rises four times as high.
Source: kinematics.
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.motions import thrown, two
from ....measuring.measured import Measured, Name, OfBody, at_least, body_index, window
from ...quantities import HEIGHTS

CODE = "WE281"


class Given(OfBody):
    """The two bodies, and the difference of their heights."""

    other: Name = Field(description="the lower body")
    of: Literal["max_height", "min_height", "final_height", "rise", "drop"] = Field(
        "max_height", description="what is compared"
    )
    min_m: float = Field(default=1e-6, gt=0, description="least difference, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the difference of the heights."""
    rows = window(trajectory, given.window_s)
    _, of = HEIGHTS[given.of]
    one, other = (of(trajectory, body_index(trajectory, name), rows) for name in (given.body, given.other))
    message = f"{given.of.replace('_', ' ')} of {given.body} is {one:.4f} m, of {given.other} {other:.4f} m"
    return at_least(one - other, given.min_m, "m", message)


def fast_and_slow() -> Trajectory:
    """`a` thrown up at 4 m/s, `b` at 2 m/s: they rise 0.8157 and 0.2039 m."""
    return two(thrown((0, 0, 4.0)), thrown((0, 0, 2.0)))


GOOD = ((fast_and_slow, {"body": "a", "other": "b", "of": "rise", "min_m": 0.61}),)
BAD = (
    (fast_and_slow, {"body": "b", "other": "a"}),
    (fast_and_slow, {"body": "a", "other": "b", "of": "rise", "min_m": 0.62}),
    (lambda: two(thrown((0, 0, 2.0)), thrown((0, 0, 2.0))), {"body": "a", "other": "b"}),
)
