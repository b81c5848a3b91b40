"""Some bodies lose mechanical energy, and never gain any on the way.

Measures the share of the energy at the start of the window (kinetic, and potential of weight above the lowest height)
that is gone at its end; the energy may never exceed an earlier value by more than `tolerance` of it.
Source: the work-energy theorem with friction and inelastic impact.
"""

import numpy as np
from pydantic import Field

from ....model.trajectory import Trajectory
from ...analytic import bouncing, falling, sliding
from ...energetics import mechanical
from ...measured import Measured, OfBodies, Tolerance, all_of, at_least, at_most, window

CODE = "WE200"
EVENT = True


class Given(OfBodies):
    """How much."""

    min_share: float = Field(gt=0, le=1, description="least share of the energy that is lost")
    tolerance: Tolerance = Field(0.02, description="largest gain on the way, relative to the energy at the start")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The share lost."""
    rows = window(trajectory, given.window_s, 2)
    energy = mechanical(trajectory, rows, given.indices(trajectory))
    start = float(energy[0])
    if start <= 0:
        return at_least(0.0, given.min_share, "1", f"{', '.join(given.names)} have no energy to lose")
    lost = float(1 - energy[-1] / start)
    gain = float((energy - np.minimum.accumulate(energy)).max() / start)
    message = f"{', '.join(given.names)} lose {lost:.1%} of {start:.4g} J"
    return all_of(
        at_least(lost, given.min_share, "1", message),
        at_most(gain, given.tolerance, "1", f"{message}, but gain {gain:.1%} on the way"),
    )


GOOD = (
    (lambda: sliding(1.0, 1.0), {"body": "body", "min_share": 0.99}),
    (lambda: bouncing(1.0, 0.8, seconds=1.0), {"body": "ball", "min_share": 0.35, "tolerance": 0.05}),  # 1 - e^2
)
BAD = (
    (falling, {"body": "body", "min_share": 0.01}),
    (lambda: sliding(1.0, 0.1), {"body": "body", "min_share": 0.9}),
)
