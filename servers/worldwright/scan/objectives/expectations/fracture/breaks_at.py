"""A constraint gives way at its strength.

Measures what it carries just before it lets go (the largest of its last three rows): its force in newtons against `load_n`,
or, of a weld, its torque in newton metres against `load_nm`.
Source: the engine's constraint forces; strength of materials.
"""

from typing import Self

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking, twisted
from ....measuring.channels import constraint_active, constraint_load, constraint_torque
from ....measuring.measured import Measured, Name, Tolerance, Windowed, at_least, close_to, window

CODE = "WE241"
EVENT = True
LAST_ROWS = 3


class Given(Windowed):
    """The constraint, and the load at which it breaks."""

    constraint: Name = Field(description="the weld, connection or pin, by its name in the program")
    load_n: float | None = Field(None, gt=0, description="its strength against forces, N")
    load_nm: float | None = Field(None, gt=0, description="or a weld's strength against torques, N m")
    tolerance: Tolerance = Field(0.1, description="relative")

    @model_validator(mode="after")
    def _one(self) -> Self:
        if (self.load_n is None) == (self.load_nm is None):
            raise ValueError("give load_n (a force, N) or load_nm (a torque, N m), and not both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the load at which it breaks."""
    rows = window(trajectory, given.window_s)
    active = constraint_active(trajectory, given.constraint)[rows]
    channel = constraint_torque if given.load_n is None else constraint_load
    carrying = channel(trajectory, given.constraint)
    load, unit, strength = carrying.values[rows], carrying.unit, given.load_n or given.load_nm or 0.0
    ends = np.flatnonzero(active[:-1] & ~active[1:])
    if not len(ends):
        most = float(load.max())
        return at_least(-strength, 0.0, unit, f"{given.constraint} does not break; it carries up to {most:.4g} {unit}")
    last = int(ends[0])
    carried = float(load[max(0, last + 1 - LAST_ROWS) : last + 1].max())
    message = f"{given.constraint} breaks at {trajectory.t[rows][last]:.3f} s, carrying {carried:.4g} {unit}"
    return close_to(carried, strength, given.tolerance, unit, message)


GOOD = (
    (breaking, {"constraint": "bolt", "load_n": 100, "tolerance": 0.01}),
    (lambda: twisted(5.0), {"constraint": "bolt", "load_nm": 5, "tolerance": 0.01}),
)
BAD = (
    (breaking, {"constraint": "bolt", "load_n": 150}),
    (lambda: breaking(10.0), {"constraint": "bolt", "load_n": 100}),
    (lambda: twisted(5.0), {"constraint": "bolt", "load_n": 5}),
    (lambda: breaking(None), {"constraint": "bolt", "load_n": 100}),
)
