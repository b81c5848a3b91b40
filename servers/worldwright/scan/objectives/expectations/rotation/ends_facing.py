"""A body ends with one of its own axes pointing in a given direction: a coin heads up, a door open, a box on its side.

Measures the angle between the axis and the direction at the last row of the window, degrees; `either_way` also accepts
the opposite direction. Source: rigid-body kinematics.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting, tilting
from ....measuring.channels import direction_of
from ....measuring.measured import Measured, OfBody, Point, at_most

CODE = "WE165"


class Given(OfBody):
    """The body, its axis, and the direction."""

    direction: Point = Field(description="direction of the world [x, y, z], any length")
    axis: Literal["x", "y", "z"] = Field("z", description="the body's own axis")
    max_angle_deg: float = Field(default=10.0, gt=0, lt=180, description="largest angle between them, deg")
    either_way: bool = Field(default=False, description="whether the opposite direction will do")

    @model_validator(mode="after")
    def _long(self) -> "Given":
        if not any(self.direction):
            raise ValueError("a direction needs a length: [0, 0, 0] points nowhere")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the angle at the end."""
    way = np.array(given.direction) / np.linalg.norm(given.direction)
    cosine = float(direction_of(trajectory, given, given.axis)[-1] @ way)
    cosine = abs(cosine) if given.either_way else cosine
    angle = float(np.degrees(np.arccos(np.clip(cosine, -1, 1))))
    message = f"in the end the {given.axis} axis of {given.body} is {angle:.1f} degrees off"
    return at_most(angle, given.max_angle_deg, "deg", message)


GOOD = (
    (lambda: tilting(90.0), {"body": "body", "direction": [1, 0, 0], "max_angle_deg": 0.5}),
    (lambda: tilting(90.0), {"body": "body", "direction": [-2, 0, 0], "either_way": True}),
    (resting, {"body": "body", "direction": [0, 0, 1]}),
)
BAD = (
    (lambda: tilting(90.0), {"body": "body", "direction": [-1, 0, 0]}),
    (lambda: tilting(45.0), {"body": "body", "direction": [1, 0, 0]}),
)
