"""Height turns into speed: what a body loses in potential energy it gains in kinetic energy.

Measures the kinetic energy gained between the highest and the lowest point in the window, relative to m g (drop). It is
1 without friction or drag, on any path: v = sqrt(2 g h). Source: conservation of energy.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import falling, resting, swinging
from ....known.motions import downhill, drifting
from ....measuring.energetics import kinetic, potential
from ....measuring.measured import Measured, OfBody, Tolerance, at_least, body_index, close_to, window

CODE = "WE203"
EVENT = True


class Given(OfBody):
    """The body, and the tolerance."""

    share: float = Field(default=1.0, gt=0, description="expected gain of kinetic energy, relative to m g (drop)")
    tolerance: Tolerance = Field(0.05, description="relative")
    min_drop_m: float = Field(default=0.01, gt=0, description="least drop, m")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the relative gain."""
    rows = window(trajectory, given.window_s, 2)
    body = body_index(trajectory, given.body)
    height, moving = potential(trajectory, rows, [body])[:, 0], kinetic(trajectory, rows, [body])[:, 0]
    low = int(height.argmin())
    high = int(height[: low + 1].argmax())
    z = trajectory.com[rows, body, 2]
    drop = float(z[high] - z[low])
    if drop < given.min_drop_m:
        return at_least(drop, given.min_drop_m, "m", f"{given.body} drops by {drop:.4f} m only")
    share = float((moving[low] - moving[high]) / (height[high] - height[low])) if height[high] > height[low] else 0.0
    message = f"{given.body} drops by {drop:.3f} m and gains {share:.1%} of that energy in speed"
    if not np.any(trajectory.gravity):
        return at_least(0.0, given.share, "1", f"{given.body} drops without gravity")
    return close_to(share, given.share, given.tolerance, "1", message)


GOOD = (
    (falling, {"body": "body", "tolerance": 0.001}),
    (lambda: downhill(30.0, rolls=True), {"body": "body", "tolerance": 0.001}),
    (lambda: downhill(30.0, friction=0.2), {"body": "body", "share": 1 - 0.2 * 3**0.5, "tolerance": 0.001}),
)
BAD = (
    (drifting, {"body": "body"}),
    (lambda: downhill(30.0, friction=0.2), {"body": "body"}),
    (resting, {"body": "body"}),
    (lambda: swinging(seconds=0.01), {"body": "bob"}),
)
