"""Find when a claim comes true: the earliest instant up to which the recording already supports it.

A claim such as "the twig breaks" or "the ball reaches 2 m/s" is false for the beginning of a recording and true for all of
it; in between lies its moment, found by bisection over beginnings of the recording. A claim that holds from the very
beginning ("stays", "conserves") has no moment, and neither has one that holds as soon as its window opens: that instant is
the plan's, and no cause can move it.
"""

from typing import Any

from ...model.recording.trajectory import Trajectory
from ..objectives import expecting

FEWEST_ROWS = 2
EDGE_ROWS = 3
"""A claim that held all along takes so many rows after its window opens to hold again."""


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
    opens_s = (arguments.get("window_s") or (trajectory.t[0],))[0]
    if opens_s > trajectory.t[0] and high - 1 <= trajectory.rows(opens_s).start + EDGE_ROWS:
        return None
    return float(trajectory.t[high - 1])
