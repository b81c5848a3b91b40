"""An event comes at the time that theory gives.

Measures the moment of the event, seconds, against `at_s`. A body dropped from h lands after sqrt(2 h / g). An event is
an expectation that comes true at a moment. Source: kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing
from ....measuring.measured import Arguments, Measured
from ...events import Event, moment_s, told

CODE = "WE289"
EVENT = True


class Given(Arguments):
    """The event, the time to expect, and the tolerance."""

    event: Event = Field(description="the event, an expectation in its own words")
    at_s: float = Field(ge=0, description="expected moment, s")
    tolerance_s: float = Field(gt=0, description="largest difference, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the moment."""
    moment = moment_s(trajectory, given.event)
    expected = f"{given.at_s:g} s within {given.tolerance_s:g} s"
    if moment is None:
        late = float(trajectory.t[-1])
        return Measured(late, expected, -max(late, given.tolerance_s), "s", f"{told(given.event)} does not happen")
    margin = given.tolerance_s - abs(moment - given.at_s)
    return Measured(moment, expected, margin, "s", f"{told(given.event)} at {moment:.4f} s")


LAND = {"touches": {"bodies": ["ball", "ground"]}}
GOOD = ((bouncing, {"event": LAND, "at_s": 0.4516, "tolerance_s": 0.003}),)  # sqrt(2 / 9.80665)
BAD = (
    (bouncing, {"event": LAND, "at_s": 0.5, "tolerance_s": 0.02}),
    (bouncing, {"event": {"moves": {"body": "ball", "min_m": 9}}, "at_s": 0.5, "tolerance_s": 0.02}),
)
