"""Two bodies that were together come apart.

Measures how far the distance between their origins grows beyond that at the start of the window, metres.
Source: kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking
from ....measuring.channels import distance
from ....measuring.measured import Measured, OfPair, at_least, window

CODE = "WE243"
EVENT = True


class Given(OfPair):
    """The two bodies, and how far they part."""

    min_m: float = Field(gt=0, description="least growth of their distance, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the growth of their distance."""
    apart = distance(trajectory, *given.bodies)
    values = apart.values[window(trajectory, given.window_s)]
    grown = float(values.max() - values[0])
    return at_least(grown, given.min_m, "m", f"{' and '.join(given.bodies)} come apart by {grown:.4f} m")


GOOD = ((breaking, {"bodies": ["upper", "lower"], "min_m": 1.2}),)  # g 0.5^2 / 2 = 1.226 m
BAD = (
    (breaking, {"bodies": ["upper", "lower"], "min_m": 1.3}),
    (lambda: breaking(None), {"bodies": ["upper", "lower"], "min_m": 0.01}),
)
