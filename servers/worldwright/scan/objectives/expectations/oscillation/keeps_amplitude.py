"""An oscillation keeps its amplitude.

Measures the largest difference between half swings, relative to the largest of them. Without damping there is none.
Source: the harmonic oscillator.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding, swinging
from ....known.oscillation import springing
from ....measuring.channels import OfSignal
from ....measuring.curves import swings
from ....measuring.measured import Measured, Tolerance, at_most, window

CODE = "WE183"


class Given(OfSignal):
    """The body or joint, and the tolerance."""

    tolerance: Tolerance = Field(description="largest difference between swings, relative")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative difference."""
    rows = window(trajectory, given.window_s, 5)
    channel = given.channel(trajectory, rows)
    _, turns = swings(trajectory.t[rows], channel.values)
    spans = np.abs(np.diff(channel.values[turns]))
    if len(spans) < 2:
        return at_most(1.0, min(given.tolerance, 0.999), "1", f"{channel.name} makes fewer than two swings")
    share = float(np.ptp(spans) / spans.max())
    message = f"{len(spans)} swings of {channel.name} from {spans.min():.4g} to {spans.max():.4g} {channel.unit}"
    return at_most(share, given.tolerance, "1", message)


GOOD = ((springing, {"body": "body", "tolerance": 0.001}), (swinging, {"body": "bob", "tolerance": 0.001}))
BAD = (
    (lambda: springing(ratio=0.02), {"body": "body", "tolerance": 0.1}),
    (sliding, {"body": "body", "tolerance": 0.5}),
)
