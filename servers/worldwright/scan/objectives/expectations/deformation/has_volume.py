"""A soft body keeps its volume, or has so much of it: rubber that bulges, a lung that fills, foam that is pressed.

Measures the volume inside the surface of a solid flex, m^3, over the window: with `tolerance` the largest relative change
since its first row, else its least and largest value. Source: the divergence theorem; an incompressible body has a
Poisson's ratio of 1/2.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.jellies import block
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, all_of, at_least, at_most, window
from ....measuring.solids import skin, volume

CODE = "WE227"
LASTING = True
MOST_ROWS = 400


class Given(Windowed):
    """Which body, how much."""

    parts: Name = Field(description="a soft body: the name of a solid flex")
    tolerance: float | None = Field(None, gt=0, description="largest change since the start of the window, relative")
    min_m3: float | None = Field(None, gt=0, description="least volume, m^3")
    max_m3: float | None = Field(None, gt=0, description="largest volume, m^3")

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if self.tolerance is None and self.min_m3 is None and self.max_m3 is None:
            raise ValueError("give tolerance, min_m3 or max_m3")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Its volume."""
    rows = window(trajectory, given.window_s)
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    inside = volume(*skin(trajectory, given.parts, chosen))
    told = f"the volume of {given.parts} is {inside.min():.4g} to {inside.max():.4g} m^3"
    found = []
    if given.tolerance is not None:
        if not inside[0] > 0:
            raise UnknowableError(f"{given.parts} encloses no volume at the start")
        change = float(np.abs(inside / inside[0] - 1).max())
        found.append(at_most(change, given.tolerance, "1", f"{told}, {change:.2%} off its first"))
    if given.min_m3 is not None:
        found.append(at_least(float(inside.min()), given.min_m3, "m^3", told))
    if given.max_m3 is not None:
        found.append(at_most(float(inside.max()), given.max_m3, "m^3", told))
    return all_of(found[0], *found[1:])


GOOD = (
    (lambda: block(squeezed=0.3), {"parts": "jelly", "tolerance": 1e-6}),
    (lambda: block(grows=1.1), {"parts": "jelly", "min_m3": 0.00799, "max_m3": 0.01065}),
)
BAD = (
    (lambda: block(grows=1.1), {"parts": "jelly", "tolerance": 0.3}),
    (lambda: block(grows=0.9), {"parts": "jelly", "min_m3": 0.007}),
    (block, {"parts": "jelly", "max_m3": 0.007}),
)
