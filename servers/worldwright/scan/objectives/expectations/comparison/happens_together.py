"""Several events come at the same time.

Measures the time between the first and the last of them, seconds. Dropped from the same height, a heavy and a light body
land together (Galileo). An event is an expectation that comes true at a moment. Source: kinematics.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing
from ....known.motions import two
from ....measuring.measured import Arguments, Measured, at_most
from ...events import Event, moment_s, told

CODE = "WE288"
EVENT = True


class Given(Arguments):
    """The events, and the largest time between them."""

    events: tuple[Event, ...] = Field(min_length=2, description="the events, two at least")
    tolerance_s: float = Field(gt=0, description="largest time between the first and the last, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the time between the first and the last."""
    moments: list[float] = []
    for event in given.events:
        moment = moment_s(trajectory, event)
        if moment is None:
            late = float(trajectory.duration_s) + given.tolerance_s
            return at_most(late * 1.001, given.tolerance_s, "s", f"{told(event)} does not happen")
        moments.append(moment)
    message = ", ".join(f"{told(event)} at {moment:.3f} s" for event, moment in zip(given.events, moments, strict=True))
    return at_most(max(moments) - min(moments), given.tolerance_s, "s", message)


LAND = [{"touches": {"bodies": [name, "ground"]}} for name in ("a", "b")]


def dropped(height: float) -> Trajectory:
    """`a` from 1 m, `b` from some height."""
    return two(bouncing(1.0, 0.3, mass=10.0), bouncing(height, 0.3))


GOOD = ((lambda: dropped(1.0), {"events": LAND, "tolerance_s": 0.005}),)
BAD = (
    (lambda: dropped(1.2), {"events": LAND, "tolerance_s": 0.02}),
    (lambda: dropped(100.0), {"events": LAND, "tolerance_s": 1.0}),
)
