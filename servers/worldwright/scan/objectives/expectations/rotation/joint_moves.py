"""A joint moves by at least so much: a door swings open, a drawer slides out, a lever is thrown.

Measures the largest change of the joint's position since the start of the window: degrees for a hinge, metres for a
slide. Source: the engine's joint coordinates.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.structures import hinged
from ....measuring.channels import joint
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, at_least, one_of, window

CODE = "WE167"
EVENT = True


class Given(Windowed):
    """The joint, and how far it must move."""

    joint: Name = Field(description="a hinge or slide")
    min_deg: float | None = Field(None, gt=0, description="least turn of a hinge, deg; or")
    min_m: float | None = Field(None, gt=0, description="least way of a slide, m")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "min_deg", "min_m")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the largest change."""
    channel = joint(trajectory, given.joint)
    least = given.min_deg if channel.unit == "deg" else given.min_m
    if least is None:
        wanted = "min_deg" if channel.unit == "deg" else "min_m"
        raise UnknowableError(f"{given.joint} is measured in {channel.unit}", next_move=f"give {wanted}")
    values = channel.values[window(trajectory, given.window_s)]
    moved = float(np.abs(values - values[0]).max())
    return at_least(moved, least, channel.unit, f"{given.joint} moves by {moved:.4g} {channel.unit}")


GOOD = ((lambda: hinged(30.0), {"joint": "hinge", "min_deg": 29.9}),)
BAD = ((lambda: hinged(30.0), {"joint": "hinge", "min_deg": 31}),)
