"""A constraint or a tendon carries a load in a given range.

Measures the largest force (or the mean) of the equality, or the tension of the tendon by its spring, damper and limit,
newtons. What hangs at rest from it loads it with its weight. Source: statics; the engine's constraint forces.
"""

from typing import Literal

from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.structures import breaking, stretched
from ....measuring.channels import constraint_load, tension
from ....measuring.measured import Measured, Name, Windowed, between, one_of, window

CODE = "WE245"


class Given(Windowed):
    """The constraint or tendon, and the range of the load."""

    constraint: Name | None = Field(None, description="a weld, connection or pin; or")
    tendon: Name | None = Field(None, description="a tendon")
    of: Literal["max", "mean"] = Field("max", description="the largest load, or the mean")
    min_n: float | None = Field(None, ge=0, description="least load, N")
    max_n: float | None = Field(None, gt=0, description="largest load, N")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "constraint", "tendon")
        if self.min_n is None and self.max_n is None:
            raise ValueError("give min_n, max_n or both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the load."""
    channel = (
        constraint_load(trajectory, given.constraint) if given.constraint else tension(trajectory, given.tendon or "")
    )
    load = channel.values[window(trajectory, given.window_s)]
    value = float(load.max() if given.of == "max" else load.mean())
    return between(value, given.min_n, given.max_n, "N", f"{channel.name} carries {value:.4g} N ({given.of})")


GOOD = (
    (breaking, {"constraint": "bolt", "min_n": 99, "max_n": 101}),
    (lambda: stretched(tension=50.0), {"tendon": "rope", "min_n": 49.9}),
)
BAD = (
    (breaking, {"constraint": "pin", "min_n": 11}),
    (breaking, {"constraint": "bolt", "max_n": 90}),
    (lambda: stretched(tension=0.0), {"tendon": "rope", "min_n": 0.1}),
)
