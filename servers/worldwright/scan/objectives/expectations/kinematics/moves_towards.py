"""A body moves in a given direction, or towards where another body is.

Measures the angle between its displacement over the window and the direction (or the way to the other body's first
position), degrees; it must get at least `min_m` away from its start. Source: kinematics, displacement.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import collision, resting, sliding
from ....measuring.measured import Measured, Name, OfBody, Point, all_of, at_least, at_most, body_index, one_of, window

CODE = "WE130"
EVENT = True


class Given(OfBody):
    """The body, and the direction or the other body."""

    direction: Point | None = Field(None, description="a direction of the world [x, y, z], any length; or")
    other: Name | None = Field(None, description="another body")
    max_angle_deg: float = Field(default=20.0, gt=0, lt=180, description="largest angle off the direction, deg")
    min_m: float = Field(default=0.01, gt=0, description="least displacement, m")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "direction", "other")
        if self.direction is not None and not any(self.direction):
            raise ValueError("a direction needs a length: [0, 0, 0] points nowhere")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the angle off the direction."""
    rows = window(trajectory, given.window_s, 2)
    path = trajectory.pos[rows, body_index(trajectory, given.body)]
    if given.other:
        way = trajectory.pos[rows.start, body_index(trajectory, given.other)] - path[0]
    else:
        way = np.array(given.direction)
    moved = path[-1] - path[0]
    far, reach = float(np.linalg.norm(moved)), float(np.linalg.norm(way))
    angle = float(np.degrees(np.arccos(np.clip(moved @ way / (far * reach), -1, 1)))) if far * reach > 0 else 180.0
    message = f"{given.body} moves by {far:.3f} m, {angle:.1f} degrees off the way to {given.other or 'the direction'}"
    return all_of(at_least(far, given.min_m, "m", message), at_most(angle, given.max_angle_deg, "deg", message))


GOOD = (
    (lambda: sliding(1.0), {"body": "body", "direction": [2, 0.1, 0]}),
    (collision, {"body": "a", "other": "b", "window_s": [0, 0.4]}),
)
BAD = (
    (lambda: sliding(1.0), {"body": "body", "direction": [0, 1, 0]}),
    (collision, {"body": "a", "other": "b", "window_s": [0.6, 1.0]}),
    (resting, {"body": "body", "direction": [1, 0, 0]}),
)
