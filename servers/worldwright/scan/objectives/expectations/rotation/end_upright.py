"""Of several bodies, so many stand upright at the end: players on their feet, pins that were missed, bottles on a belt.

Counts those whose z axis stays within some degrees of where it pointed at the start of the window, all through the last second
of it; turning about the vertical does not count. Who fell and stands again counts. Source: rigid-body kinematics.
"""

import numpy as np
from pydantic import Field

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, tilting
from ....measuring.channels import OfParts, group
from ....measuring.measured import Measured, at_least, window

CODE = "WE169"
LASTING = True


class Given(OfParts):
    """The bodies, how many of them, and what counts as upright."""

    min_count: int = Field(ge=1, description="least number that stands")
    max_tilt_deg: float = Field(default=30.0, gt=0, lt=180, description="largest tilt that counts as standing, deg")
    for_s: float = Field(default=1.0, gt=0, description="how long, at the end of the window, they stand, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Count those that stand."""
    rows, bodies = window(trajectory, given.window_s), group(trajectory, given.parts)
    since = float(trajectory.t[rows.stop - 1]) - given.for_s
    last = slice(max(rows.start, int(trajectory.t.searchsorted(since))), rows.stop)
    first = matrices(trajectory.quat[rows.start, bodies])[:, :, 2]
    axes = np.stack([matrices(trajectory.quat[last, body])[:, :, 2] for body in bodies], axis=1)
    tilt = np.degrees(np.arccos(np.clip((axes * first).sum(axis=2), -1, 1)).max(axis=0))
    stands = tilt <= given.max_tilt_deg
    lies = [trajectory.names[body] for body, up in zip(bodies, stands, strict=True) if not up]
    message = (
        f"{int(stands.sum())} of {len(bodies)} stand at the end, tilted by {tilt.min():.1f} to {tilt.max():.1f} degrees"
    )
    message += f"; not: {', '.join(lies[:5])}" if lies else ""
    return at_least(float(stands.sum()), float(given.min_count), "1", message)


GOOD = ((resting, {"parts": ["body"], "min_count": 1}), (lambda: tilting(20.0), {"parts": ["body"], "min_count": 1}))
BAD = (
    (lambda: tilting(45.0), {"parts": ["body"], "min_count": 1}),
    (resting, {"parts": ["body"], "min_count": 2}),
)
