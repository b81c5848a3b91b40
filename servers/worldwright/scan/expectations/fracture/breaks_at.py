"""A constraint gives way at its strength.

Measures the load it carries just before it lets go (the largest of its last three rows), newtons, against `load_n`.
A weld's load is the norm of its force and its torque (N and N m alike); a connection's is its force alone.
Source: the engine's constraint forces; strength of materials.
"""

import numpy as np
from pydantic import Field

from ....model.trajectory import Trajectory
from ...channels import constraint_active, constraint_load
from ...known.structures import breaking
from ...measured import Measured, Name, Tolerance, Windowed, at_least, close_to, window

CODE = "WE241"
EVENT = True
LAST_ROWS = 3


class Given(Windowed):
    """Which, at which load."""

    constraint: Name = Field(description="the weld, connection or pin, by its name in the program")
    load_n: float = Field(gt=0, description="its strength, N")
    tolerance: Tolerance = Field(0.1, description="relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The load at which it breaks."""
    rows = window(trajectory, given.window_s)
    active = constraint_active(trajectory, given.constraint)[rows]
    load = constraint_load(trajectory, given.constraint).values[rows]
    ends = np.flatnonzero(active[:-1] & ~active[1:])
    if not len(ends):
        most = float(load.max())
        return at_least(-given.load_n, 0.0, "N", f"{given.constraint} does not break; it carries up to {most:.4g} N")
    last = int(ends[0])
    carried = float(load[max(0, last + 1 - LAST_ROWS) : last + 1].max())
    message = f"{given.constraint} breaks at {trajectory.t[rows][last]:.3f} s, carrying {carried:.4g} N"
    return close_to(carried, given.load_n, given.tolerance, "N", message)


GOOD = ((breaking, {"constraint": "bolt", "load_n": 100, "tolerance": 0.01}),)
BAD = (
    (breaking, {"constraint": "bolt", "load_n": 150}),
    (lambda: breaking(10.0), {"constraint": "bolt", "load_n": 100}),
    (lambda: breaking(None), {"constraint": "bolt", "load_n": 100}),
)
