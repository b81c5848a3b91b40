"""A body gets to a place, or to another body.

Measures the smallest distance of its origin from the point, or from the other body's origin, metres.
Source: kinematics.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, sliding
from ....measuring.measured import Measured, Name, OfBody, Point, at_most, body_index, one_of, window

CODE = "WE121"
EVENT = True


class Given(OfBody):
    """The body, the place, and how near it must get."""

    place: Point | None = Field(None, description="a point of the world [x, y, z], m; or")
    other: Name | None = Field(None, description="another body")
    tolerance_m: float = Field(gt=0, description="how near counts, m")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "place", "other")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the nearest it gets."""
    rows = window(trajectory, given.window_s)
    path = trajectory.pos[rows, body_index(trajectory, given.body)]
    if given.other:
        goal, there = trajectory.pos[rows, body_index(trajectory, given.other)], given.other
    else:
        goal, there = np.array(given.place), "the place"
    apart = np.linalg.norm(path - goal, axis=1)
    near = int(apart.argmin())
    when = trajectory.t[rows][near]
    message = f"{given.body} is nearest to {there} at {when:.3f} s, {apart[near]:.4f} m away"
    return at_most(float(apart[near]), given.tolerance_m, "m", message)


GOOD = (
    (lambda: sliding(1.0, seconds=2.0), {"body": "body", "place": [1.5, 0, 0.05], "tolerance_m": 0.01}),
    (collision, {"body": "a", "other": "b", "tolerance_m": 0.11}),
)
BAD = (
    (lambda: sliding(1.0, seconds=2.0), {"body": "body", "place": [2.5, 0, 0.05], "tolerance_m": 0.4}),
    (collision, {"body": "a", "other": "b", "tolerance_m": 0.05}),
)
