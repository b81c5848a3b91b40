"""When a claim comes true: the earliest instant up to which the recording already supports it.

A claim such as "the twig breaks" or "the ball reaches 2 m/s" is false of the beginning of a recording and true of all of
it; in between lies its moment, found by bisection over beginnings of the recording. A claim that holds from the very
beginning ("stays", "conserves") has no moment.
"""

from typing import Any

from ...model.trajectory import Trajectory
from .. import expecting

FEWEST_ROWS = 2


def event_s(trajectory: Trajectory, name: str, arguments: dict[str, Any]) -> float | None:
    """The moment of one expectation that holds, s; None when it has none."""

    def holds(rows: int) -> bool:
        try:
            return expecting.measure(trajectory.before(rows), name, arguments).status == "holds"
        except Exception:  # an expectation may ask for a window that this beginning does not reach
            return False

    low, high = FEWEST_ROWS, len(trajectory.t)
    if high <= low or holds(low):
        return None
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (low, middle) if holds(middle) else (middle, high)
    return float(trajectory.t[high - 1])
