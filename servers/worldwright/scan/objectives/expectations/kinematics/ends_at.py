"""A body ends at a place, or at another body.

Measures the distance of its origin from the point, or from the other body's origin, at the last row of the window,
metres. Source: kinematics.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....measuring.measured import Measured, Name, OfBody, Point, at_most, body_index, one_of, window

CODE = "WE132"


class Given(OfBody):
    """The body, the place, and how near it must be."""

    place: Point | None = Field(None, description="a point of the world [x, y, z], m; or")
    other: Name | None = Field(None, description="another body")
    tolerance_m: float = Field(gt=0, description="how near counts, m")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "place", "other")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the distance at the end."""
    last = window(trajectory, given.window_s).stop - 1
    here = trajectory.pos[last, body_index(trajectory, given.body)]
    goal = np.array(given.place) if given.place else trajectory.pos[last, body_index(trajectory, given.other or "")]
    apart = float(np.linalg.norm(here - goal))
    message = f"at {trajectory.t[last]:.3f} s {given.body} is {apart:.4f} m from {given.other or 'the place'}"
    return at_most(apart, given.tolerance_m, "m", message)


GOOD = ((lambda: sliding(1.0, 1.0), {"body": "body", "place": [0.5, 0, 0.05], "tolerance_m": 0.01}),)  # v^2 / 2 a
BAD = ((lambda: sliding(1.0, 0.0), {"body": "body", "place": [0.5, 0, 0.05], "tolerance_m": 0.01}),)  # only passes it
