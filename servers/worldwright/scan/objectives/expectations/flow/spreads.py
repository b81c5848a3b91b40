"""A crowd of bodies spreads: a puddle, a heap, an opening rack of balls.

Measures the radius of gyration of their origins, or of the points of a law, seen from above, at the end of the window
relative to its start. Source: statistics of point sets; diffusion and collapse of granular columns.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd
from ....measuring.channels import OfParts
from ....measuring.clouds import cloud
from ....measuring.measured import Measured, UnknowableError, at_least, window

CODE = "WE264"
EVENT = True


class Given(OfParts):
    """The crowd, and the growth to reach."""

    min_ratio: float = Field(gt=1, description="least growth of the radius of gyration, times")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the growth."""
    rows = window(trajectory, given.window_s)
    ends = cloud(trajectory, given.parts, (rows.start, rows.stop - 1))[:, :, :2]
    apart = ends - ends.mean(axis=1, keepdims=True)
    radius = np.sqrt((apart**2).sum(axis=2).mean(axis=1))
    if ends.shape[1] < 2 or radius[0] <= 0:
        raise UnknowableError(
            f"{given.told()} has no extent at the start", next_move="name several bodies, or the points of a law"
        )
    ratio = float(radius[1] / radius[0])
    message = f"{given.told()} spreads from {radius[0]:.4f} to {radius[1]:.4f} m"
    return at_least(ratio, given.min_ratio, "1", message)


GOOD = ((crowd, {"parts": "grain_*", "min_ratio": 2.99}),)
BAD = (
    (crowd, {"parts": "grain_*", "min_ratio": 3.1}),
    (lambda: crowd(1.0, shift=2.0), {"parts": "grain_*", "min_ratio": 1.01}),
)
