"""A constraint gives way: a weld, a connection or a pin that held lets go.

Measures how many recorded rows it is off after it held. Source: the engine's equality constraints.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking
from ....measuring.channels import constraint_active
from ....measuring.measured import Measured, Name, Windowed, at_least, window

CODE = "WE240"
EVENT = True


class Given(Windowed):
    """The constraint."""

    constraint: Name = Field(description="the weld, connection or pin, by its name in the program")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of rows after it broke."""
    rows = window(trajectory, given.window_s)
    active = constraint_active(trajectory, given.constraint)[rows]
    first = int(active.argmax())
    off = ~active[first:] & bool(active.any())
    count = int(off.sum())
    if count:
        message = f"{given.constraint} breaks at {trajectory.t[rows][first + int(off.argmax())]:.3f} s"
    else:
        message = f"{given.constraint} holds" if active.any() else f"{given.constraint} never held"
    return at_least(count, 1, "rows", message)


GOOD = ((breaking, {"constraint": "bolt"}),)
BAD = ((breaking, {"constraint": "pin"}), (lambda: breaking(None), {"constraint": "bolt"}))
