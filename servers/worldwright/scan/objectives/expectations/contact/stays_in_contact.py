"""Two bodies stay in contact.

Measures the share of the rows in which they touch; hops of up to 20 ms, as stiff contacts make, count as touching.
Source: the engine's contacts.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, resting
from ....measuring.measured import Measured, OfPair, at_least, bridged, pair_rows, window

CODE = "WE145"
LASTING = True


class Given(OfPair):
    """The two bodies, and the share of the time."""

    min_share: float = Field(default=0.95, gt=0, le=1, description="least share of the time in contact")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share of the time."""
    rows = window(trajectory, given.window_s)
    share = float(bridged(trajectory, pair_rows(trajectory, *given.bodies)[rows]).mean())
    return at_least(share, given.min_share, "1", f"{' and '.join(given.bodies)} touch for {share:.1%} of the time")


GOOD = ((resting, {"bodies": ["body", "ground"], "min_share": 1.0}),)
BAD = ((lambda: bouncing(1.0, 0.8), {"bodies": ["ball", "ground"]}),)
