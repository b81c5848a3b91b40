"""The recording's clock stands still or runs backwards.

What it means: rows were lost, doubled or shuffled, or two recordings were joined. Only the rows in order are looked at.

Formula: rows whose time is not larger than that of every row before.
Threshold: none.
Source: the interchange's definition, `t` strictly increasing.
"""

from collections.abc import Iterator
from dataclasses import replace

from ...model.trajectory import Trajectory
from .. import analytic
from ..sign import Case, Context, Sign

CODE = "WS132"
NEEDS = ("t",)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield the rows that were out of order."""
    late = trajectory.out_of_order
    if late:
        message = f"{len(late)} rows are not later than the ones before them and were left out"
        yield Sign("world", (min(late), max(late)), len(late), 0, "rows", "blocking", message)


GOOD = (lambda: Case("rows in order", analytic.resting()),)
BAD = (lambda: Case("a doubled row", replace(analytic.resting(), out_of_order=(0.5,)), severity="blocking"),)
