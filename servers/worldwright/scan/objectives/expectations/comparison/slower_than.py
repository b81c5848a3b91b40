"""One body is slower than another.

Measures the ratio of their speeds (or spins), that of `body` over that of `other`. A cylinder rolls down an incline
slower than a ball: 2/3 against 5/7 of g sin(angle). Source: kinematics.
"""

from typing import Literal

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....known.motions import two
from ....measuring.measured import Measured, Name, OfBody, at_most, body_index, window
from ...quantities import SPEEDS

CODE = "WE280"


class Given(OfBody):
    """The two bodies, and the ratio of their speeds."""

    other: Name = Field(description="the faster body")
    of: Literal["max_speed", "mean_speed", "final_speed", "max_spin"] = Field(
        "mean_speed", description="what is compared"
    )
    max_ratio: float = Field(default=1.0, gt=0, le=1, description="largest ratio, slower over faster")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the ratio of the speeds."""
    rows = window(trajectory, given.window_s)
    unit, of = SPEEDS[given.of]
    one, other = (of(trajectory, body_index(trajectory, name), rows) for name in (given.body, given.other))
    message = f"{given.of.replace('_', ' ')} of {given.body} is {one:.4g} {unit}, of {given.other} {other:.4g} {unit}"
    # Equal is not slower: a bare comparison must not have the margin zero then.
    ratio = one / other if other > 0 else 2.0
    return at_most(ratio + 1e-9, given.max_ratio, "1", message)


def slow_and_fast() -> Trajectory:
    """`a` at 0.6 m/s, `b` at 1 m/s."""
    return two(sliding(0.6), sliding(1.0))


GOOD = ((slow_and_fast, {"body": "a", "other": "b"}), (slow_and_fast, {"body": "a", "other": "b", "max_ratio": 0.61}))
BAD = (
    (slow_and_fast, {"body": "b", "other": "a"}),
    (slow_and_fast, {"body": "a", "other": "b", "max_ratio": 0.5}),
    (lambda: two(sliding(1.0), sliding(1.0)), {"body": "a", "other": "b"}),
)
