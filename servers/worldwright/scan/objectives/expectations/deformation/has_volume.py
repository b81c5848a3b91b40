"""A soft body keeps its volume, or has so much of it: rubber that bulges, a lung that fills, foam that is pressed, a bottle
that caves in.

Measures the volume inside the surface of a solid flex, or of a closed skin that a law moves, m^3, over the window: with
`tolerance` the largest relative change since its first row, with `min_ratio` and `max_ratio` its last over its first, else
its least and largest value. Source: the divergence theorem; an incompressible body has a Poisson's ratio of 1/2.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.jellies import block, caving
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, all_of, at_least, at_most, between, window
from ....measuring.solids import skin, volume

CODE = "WE227"
LASTING = True
MOST_ROWS = 400


class Given(Windowed):
    """Which body, how much."""

    parts: Name = Field(description="a soft body: the name of a solid flex, or what shows a law's skin")
    tolerance: float | None = Field(None, gt=0, description="largest change since the start of the window, relative")
    min_m3: float | None = Field(None, gt=0, description="least volume, m^3")
    max_m3: float | None = Field(None, gt=0, description="largest volume, m^3")
    min_ratio: float | None = Field(None, gt=0, description="least volume at the end, as a share of that at the start")
    max_ratio: float | None = Field(
        None, gt=0, description="largest volume at the end, as a share of that at the start"
    )

    @model_validator(mode="after")
    def _some(self) -> "Given":
        if all(v is None for v in (self.tolerance, self.min_m3, self.max_m3, self.min_ratio, self.max_ratio)):
            raise ValueError("give tolerance, min_m3, max_m3, min_ratio or max_ratio")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Its volume."""
    rows = window(trajectory, given.window_s)
    chosen = np.unique(np.linspace(rows.start, rows.stop - 1, min(MOST_ROWS, rows.stop - rows.start)).astype(int))
    inside = volume(*skin(trajectory, given.parts, chosen))
    told = f"the volume of {given.parts} is {inside.min():.4g} to {inside.max():.4g} m^3"
    found = []
    relative = (given.tolerance, given.min_ratio, given.max_ratio)
    if any(v is not None for v in relative) and not inside[0] > 0:
        raise UnknowableError(f"{given.parts} encloses no volume at the start")
    if given.min_ratio is not None or given.max_ratio is not None:
        share = float(inside[-1] / inside[0])
        message = f"the volume of {given.parts} ends at {share:.1%} of its first, {inside[0]:.4g} m^3"
        found.append(between(share, given.min_ratio, given.max_ratio, "1", message))
    if given.tolerance is not None:
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
    (caving, {"parts": "walls", "min_ratio": 0.499, "max_ratio": 0.501}),
    (caving, {"parts": "walls", "min_m3": 0.00399, "max_m3": 0.00801}),
)
BAD = (
    (lambda: block(grows=1.1), {"parts": "jelly", "tolerance": 0.3}),
    (lambda: block(grows=0.9), {"parts": "jelly", "min_m3": 0.007}),
    (block, {"parts": "jelly", "max_m3": 0.007}),
    (caving, {"parts": "walls", "max_ratio": 0.45}),
)
