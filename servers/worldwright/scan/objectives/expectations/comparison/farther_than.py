"""One body gets farther than another.

Measures the ratio of their ways, `body` over `other`: the largest displacement from the start, or the length of the path.
A throw at twice the speed goes four times as far. Source: kinematics.
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, sliding
from ....known.motions import two
from ....measuring.measured import Measured, Name, OfBody, at_least, body_index, window
from ...quantities import WAYS

CODE = "WE282"


class Given(OfBody):
    """The two bodies, and the ratio of their ways."""

    other: Name = Field(description="the body that stays behind")
    of: Literal["displacement", "path"] = Field("displacement", description="what is compared")
    min_ratio: float = Field(default=1.000001, gt=1, description="least ratio, farther over nearer")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the ratio of the ways."""
    rows = window(trajectory, given.window_s)
    _, of = WAYS[given.of]
    one, other = (of(trajectory, body_index(trajectory, name), rows) for name in (given.body, given.other))
    message = f"{given.of} of {given.body} is {one:.4f} m, of {given.other} {other:.4f} m"
    ratio = one / other if other > 0 else (1e9 if one > 0 else 1.0)
    return at_least(ratio, given.min_ratio, "1", message)


def braked() -> Trajectory:
    """`a` and `b` braked alike from 2 and 1 m/s: 2 m and 0.5 m."""
    return two(sliding(2.0, 1.0, seconds=2.5), sliding(1.0, 1.0, seconds=2.5))


GOOD = ((braked, {"body": "a", "other": "b", "min_ratio": 3.99}),)
BAD = (
    (braked, {"body": "a", "other": "b", "min_ratio": 4.1}),
    (braked, {"body": "b", "other": "a"}),
    (lambda: two(resting(), resting()), {"body": "a", "other": "b"}),
)
