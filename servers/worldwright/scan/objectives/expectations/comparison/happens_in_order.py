"""Several events come in a given order: dominoes fall one after another, a chain reaction runs.

Measures the shortest time between an event and the next one, seconds. An event is an expectation that comes true at a
moment. Source: kinematics, order of events.
"""

from itertools import pairwise

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing
from ....measuring.measured import Arguments, Measured, at_least
from ...events import Event, moment_s, told

CODE = "WE287"
EVENT = True


class Given(Arguments):
    """The events in their order."""

    events: tuple[Event, ...] = Field(min_length=2, description="the events in their order, two at least")
    min_s: float = Field(default=1e-6, gt=0, description="least time between one and the next, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the shortest time from one to the next."""
    moments: list[float] = []
    for event in given.events:
        moment = moment_s(trajectory, event)
        if moment is None:
            return at_least(
                -float(trajectory.duration_s) - given.min_s, given.min_s, "s", f"{told(event)} does not happen"
            )
        moments.append(moment)
    gaps = [later - earlier for earlier, later in pairwise(moments)]
    worst = gaps.index(min(gaps))
    order = ", ".join(f"{told(event)} at {moment:.3f} s" for event, moment in zip(given.events, moments, strict=True))
    return at_least(gaps[worst], given.min_s, "s", order)


STEPS = [{"falls": {"body": "ball", "min_m": drop}} for drop in (0.2, 0.5, 0.9)]
GOOD = ((bouncing, {"events": [*STEPS, {"touches": {"bodies": ["ball", "ground"]}}]}),)
BAD = (
    (bouncing, {"events": [STEPS[1], STEPS[0]]}),
    (bouncing, {"events": [STEPS[0], {"moves": {"body": "ball", "min_m": 5}}]}),
)
