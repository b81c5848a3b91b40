"""An oscillation dies out: each swing is smaller than the one before.

Measures the damping ratio from the logarithmic decrement of successive half swings, z = d / sqrt(pi^2 + d^2), fitted
over all of them; with `damping_ratio` it must agree, and without it the swings must lose at least `min_loss` of their
size from the first to the last. Source: the damped harmonic oscillator.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding, swinging
from ....known.oscillation import springing
from ....measuring.channels import OfSignal
from ....measuring.curves import polynomial, swings
from ....measuring.measured import Measured, Tolerance, at_least, close_to, window

CODE = "WE182"


class Given(OfSignal):
    """The body or joint, and the damping or loss to expect."""

    damping_ratio: float | None = Field(None, gt=0, lt=1, description="expected damping ratio (1 is critical); or")
    tolerance: Tolerance = Field(0.1, description="relative, of the damping ratio")
    min_loss: float = Field(default=0.2, gt=0, lt=1, description="least share of its size that the swing loses in all")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the damping ratio, or the loss."""
    rows = window(trajectory, given.window_s, 5)
    channel = given.channel(trajectory, rows)
    _, turns = swings(trajectory.t[rows], channel.values)
    spans = np.abs(np.diff(channel.values[turns]))
    if len(spans) < 2:
        return at_least(0.0, given.min_loss, "1", f"{channel.name} makes fewer than two swings")
    decrement = -float(polynomial(np.arange(len(spans)) * 1.0, np.log(spans), 1)[0][1, 0])
    ratio = decrement / np.sqrt(np.pi**2 + decrement**2)
    loss = float(1 - spans[-1] / spans[0])
    message = f"{len(spans)} swings of {channel.name} lose {loss:.1%} of their size: damping ratio {ratio:.4f}"
    if given.damping_ratio is not None:
        return close_to(ratio, given.damping_ratio, given.tolerance, "1", message)
    return at_least(loss, given.min_loss, "1", message)


GOOD = (
    (lambda: springing(ratio=0.05), {"body": "body", "damping_ratio": 0.05, "tolerance": 0.01}),
    (lambda: swinging(damping=0.3, seconds=6), {"body": "bob"}),
)
BAD = (
    (lambda: springing(ratio=0.05), {"body": "body", "damping_ratio": 0.1}),
    (springing, {"body": "body"}),
    (sliding, {"body": "body"}),
)
