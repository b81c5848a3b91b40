"""One event comes before another.

Measures the time from `first` to `then`, seconds. An event is an expectation that comes true at a moment; its moment is
the earliest instant up to which the recording already supports it. Source: kinematics, order of events.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing
from ....measuring.measured import Arguments, Measured, at_least
from ...events import Event, moment_s, told

CODE = "WE286"
EVENT = True


class Given(Arguments):
    """The two events."""

    first: Event = Field(description="the earlier event, an expectation in its own words")
    then: Event = Field(description="the later event")
    min_s: float = Field(default=1e-6, gt=0, description="least time between them, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the time between them."""
    moments = [moment_s(trajectory, event) for event in (given.first, given.then)]
    for event, moment in zip((given.first, given.then), moments, strict=True):
        if moment is None:
            return at_least(
                -float(trajectory.duration_s) - given.min_s, given.min_s, "s", f"{told(event)} does not happen"
            )
    early, late = (float(moment or 0.0) for moment in moments)
    message = f"{told(given.first)} at {early:.3f} s, {told(given.then)} at {late:.3f} s"
    return at_least(late - early, given.min_s, "s", message)


FALLS = {"falls": {"body": "ball", "min_m": 0.5}}
HITS = {"touches": {"bodies": ["ball", "ground"]}}
UP = {"rises": {"body": "ball", "min_m": 0.3}}
GOOD = (
    (bouncing, {"first": FALLS, "then": HITS}),
    (bouncing, {"first": HITS, "then": UP, "min_s": 0.08}),
)
BAD = (
    (bouncing, {"first": HITS, "then": FALLS}),
    (lambda: bouncing(restitution=0.3), {"first": HITS, "then": UP}),
)
