"""A body spins at a constant rate.

Measures the largest change of its angular speed over the window, relative to the mean; with `rate_rad_s` the mean must
agree too. A free rigid body turning about a principal axis keeps its rate. Source: Euler's equations.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.rotation import spinning
from ....measuring.measured import Measured, OfBody, Tolerance, all_of, at_most, body_index, close_to, window

CODE = "WE160"
LASTING = True
STILL_RAD_S = 1e-6


class Given(OfBody):
    """The body, the tolerance, and the rate to expect."""

    tolerance: Tolerance = Field(description="relative, of the change and of the rate")
    rate_rad_s: float | None = Field(None, gt=0, description="expected angular speed, rad/s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative change."""
    spin = trajectory.spin[window(trajectory, given.window_s, 2), body_index(trajectory, given.body)]
    mean = float(spin.mean())
    if mean < STILL_RAD_S:
        return at_most(1.0, min(given.tolerance, 0.999), "1", f"{given.body} does not spin")
    share = float(np.abs(spin - mean).max() / mean)
    message = f"{given.body} spins at {mean:.4f} rad/s within {share:.2%}"
    steady = at_most(share, given.tolerance, "1", message)
    if given.rate_rad_s is None:
        return steady
    return all_of(steady, close_to(mean, given.rate_rad_s, given.tolerance, "rad/s", message))


GOOD = ((lambda: spinning(10.0), {"body": "body", "tolerance": 0.001, "rate_rad_s": 10}),)
BAD = (
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "tolerance": 0.05}),
    (lambda: spinning(10.0), {"body": "body", "tolerance": 0.01, "rate_rad_s": 11}),
    (resting, {"body": "body", "tolerance": 0.5}),
)
