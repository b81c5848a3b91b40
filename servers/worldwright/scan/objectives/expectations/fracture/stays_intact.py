"""A constraint holds all the time, also while another one breaks.

Measures the share of the rows in which it is on. With `while_breaks` the other one must give way.
Source: the engine's equality constraints.
"""

from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking
from ....measuring.channels import constraint_active
from ....measuring.measured import Measured, Name, Windowed, all_of, at_least, window

CODE = "WE242"
LASTING = True


class Given(Windowed):
    """The constraint, and the one that breaks meanwhile."""

    constraint: Name = Field(description="the weld, connection or pin that holds")
    while_breaks: Name | None = Field(None, description="another one that breaks meanwhile")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share of the time it holds."""
    rows = window(trajectory, given.window_s)
    held = float(constraint_active(trajectory, given.constraint)[rows].mean())
    holds = at_least(held, 1.0, "1", f"{given.constraint} holds for {held:.1%} of the time")
    if not given.while_breaks:
        return holds
    other = constraint_active(trajectory, given.while_breaks)[rows]
    broken = bool(other.any() and not other[int(other.argmax()) :].all())
    told = f"{given.while_breaks} {'breaks' if broken else 'does not break'}, {holds.message}"
    return all_of(holds._replace(message=told), at_least(float(broken), 1.0, "1", told))


GOOD = ((breaking, {"constraint": "pin"}), (breaking, {"constraint": "pin", "while_breaks": "bolt"}))
BAD = (
    (breaking, {"constraint": "bolt"}),
    (lambda: breaking(None), {"constraint": "pin", "while_breaks": "bolt"}),
)
