"""A crowd of bodies, or a medium of points, stays inside a box of space: a glass that holds its water, a tray its beads.

Measures the least share of them inside at any moment. A side that is null is open. Source: kinematics.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd
from ....known.own_laws import pouring
from ....measuring.channels import OfParts
from ....measuring.clouds import cloud
from ....measuring.measured import Measured, at_least, window

CODE = "WE266"
LASTING = True
Corner = tuple[float | None, float | None, float | None]


class Given(OfParts):
    """The crowd, the box, and the share that must stay inside."""

    low: Corner = Field((None, None, None), description="lower corner [x, y, z], m; null leaves a side open")
    high: Corner = Field((None, None, None), description="upper corner [x, y, z], m; null leaves a side open")
    min_share: float = Field(default=1.0, gt=0, le=1, description="least share of them inside at any moment")

    @model_validator(mode="after")
    def _closed(self) -> "Given":
        if all(side is None for side in (*self.low, *self.high)):
            raise ValueError("give at least one side of the box in `low` or `high`")
        return self


def inside(points: np.ndarray, low: Corner, high: Corner) -> np.ndarray:
    """(...) bool: whether each of the points (..., 3) lies in the box."""
    least = np.array([-np.inf if v is None else v for v in low])
    most = np.array([np.inf if v is None else v for v in high])
    return np.all((points >= least) & (points <= most), axis=-1)


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the least share inside."""
    whole = window(trajectory, given.window_s)
    if (
        given.parts in trajectory.media.names
    ):  # each recorded instant of its points once: together they may be gigabytes
        lay = trajectory.media.of(str(given.parts))
        rows = np.unique(np.searchsorted(lay.t, trajectory.t[whole] + 1e-9), return_index=True)[1] + whole.start
        share = np.array([inside(lay.at(float(time)), given.low, given.high).mean() for time in trajectory.t[rows]])
    else:
        rows = np.arange(whole.start, whole.stop)
        share = inside(cloud(trajectory, given.parts, rows), given.low, given.high).mean(axis=1)
    worst = int(share.argmin())
    message = f"at {trajectory.t[rows[worst]]:.3f} s {share[worst]:.1%} of {given.told()} is inside, the least of all"
    return at_least(float(share[worst]), given.min_share, "1", message)


GOOD = (
    (crowd, {"parts": "grain_*", "low": [-0.4, -0.4, 0], "high": [0.4, 0.4, None]}),
    (pouring, {"parts": "paint", "low": [-0.21, -0.11, 0.049], "high": [0.21, 0.11, 0.053]}),
)
BAD = (
    (crowd, {"parts": "grain_*", "low": [-0.2, -0.2, 0], "high": [0.2, 0.2, None], "min_share": 0.9}),
    (pouring, {"parts": "paint", "high": [None, None, 0.051], "min_share": 0.5}),
)
