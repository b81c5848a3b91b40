"""A constraint gives way at its strength.

Measures what it carries just before it lets go (the largest of its last three rows): its force in newtons against `load_n`;
of a weld its torque in newton metres against `load_nm`; of a bond between the pieces of what breaks the largest tension in its
section, in pascals, against `stress_pa`.
Source: the engine's constraint forces; strength of materials.
"""

from typing import Self

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking, stressed, twisted
from ....measuring.channels import bond_stress, constraint_active, constraint_load, constraint_torque
from ....measuring.measured import Measured, Name, Tolerance, Windowed, at_least, close_to, window

CODE = "WE241"
EVENT = True
LAST_ROWS = 3


class Given(Windowed):
    """The constraint, and the load at which it breaks."""

    constraint: Name = Field(description="the weld, connection or pin, by its name in the program")
    load_n: float | None = Field(None, gt=0, description="its strength against forces, N")
    load_nm: float | None = Field(None, gt=0, description="or a weld's strength against torques, N m")
    stress_pa: float | None = Field(None, gt=0, description="or a bond's strength, Pa")
    tolerance: Tolerance = Field(0.1, description="relative")

    @model_validator(mode="after")
    def _one(self) -> Self:
        if sum(given is not None for given in (self.load_n, self.load_nm, self.stress_pa)) != 1:
            raise ValueError("give one of load_n (a force, N), load_nm (a torque, N m) and stress_pa (of a bond, Pa)")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the load at which it breaks."""
    rows = window(trajectory, given.window_s)
    active = constraint_active(trajectory, given.constraint)[rows]
    named = ((given.load_n, constraint_load), (given.load_nm, constraint_torque), (given.stress_pa, bond_stress))
    strength, channel = next((wanted, of) for wanted, of in named if wanted is not None)
    carrying = channel(trajectory, given.constraint)
    load, unit = carrying.values[rows], carrying.unit
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
    (lambda: stressed(4e7), {"constraint": "bolt", "stress_pa": 4e7, "tolerance": 0.01}),
)
BAD = (
    (breaking, {"constraint": "bolt", "load_n": 150}),
    (lambda: breaking(10.0), {"constraint": "bolt", "load_n": 100}),
    (lambda: twisted(5.0), {"constraint": "bolt", "load_n": 5}),
    (lambda: stressed(4e7), {"constraint": "bolt", "stress_pa": 5e7}),
    (lambda: breaking(None), {"constraint": "bolt", "load_n": 100}),
)
