"""Bodies stay inside a box of space.

Measures how deep inside the box the origin of the body nearest to leaving it stays, metres (negative: outside). A side
that is null is open. Source: kinematics.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, sliding
from ....measuring.measured import Measured, OfBodies, at_least, window

CODE = "WE122"
LASTING = True
Corner = tuple[float | None, float | None, float | None]


class Given(OfBodies):
    """The bodies, and the box."""

    low: Corner = Field((None, None, None), description="lower corner [x, y, z], m; null leaves a side open")
    high: Corner = Field((None, None, None), description="upper corner [x, y, z], m; null leaves a side open")

    @model_validator(mode="after")
    def _closed(self) -> "Given":
        if all(side is None for side in (*self.low, *self.high)):
            raise ValueError("give at least one side of the box in `low` or `high`")
        if any(a is not None and b is not None and a >= b for a, b in zip(self.low, self.high, strict=True)):
            raise ValueError("`low` must be below `high` along every axis")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the least distance to a side."""
    rows = window(trajectory, given.window_s)
    path = trajectory.pos[rows][:, given.indices(trajectory)]
    low = np.array([-np.inf if v is None else v for v in given.low])
    high = np.array([np.inf if v is None else v for v in given.high])
    inside = np.minimum(path - low, high - path).min(axis=2)
    row, body = np.unravel_index(inside.argmin(), inside.shape)
    least, name = float(inside[row, body]), given.names[body]
    where = f"{least:.4f} m inside" if least >= 0 else f"{-least:.4f} m outside"
    return at_least(least, 0.0, "m", f"{name} is {where} the box at {trajectory.t[rows][row]:.3f} s, its worst moment")


GOOD = ((bouncing, {"body": "ball", "low": [-1, -1, 0.04], "high": [1, 1, 1.2]}),)
BAD = (
    (bouncing, {"body": "ball", "low": [None, None, 0.06]}),
    (lambda: sliding(1.0, seconds=2.0), {"bodies": ["body"], "high": [1.9, None, None]}),
)
