"""A crowd of bodies, or a medium of points, gets into a box of space: water into a glass, sand into the lower bulb.

Measures the share of them that is outside at the start of the window and inside at its end. A side that is null is
open. Source: kinematics; conservation of mass.
"""

from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.flow import crowd
from ....measuring.channels import OfParts
from ....measuring.clouds import cloud
from ....measuring.measured import Measured, at_least, window
from .stays_contained import Corner, inside

CODE = "WE267"
EVENT = True


class Given(OfParts):
    """The crowd, the box, and the share that must get in."""

    low: Corner = Field((None, None, None), description="lower corner [x, y, z], m; null leaves a side open")
    high: Corner = Field((None, None, None), description="upper corner [x, y, z], m; null leaves a side open")
    min_share: float = Field(gt=0, le=1, description="least share of them that gets in")

    @model_validator(mode="after")
    def _closed(self) -> "Given":
        if all(side is None for side in (*self.low, *self.high)):
            raise ValueError("give at least one side of the box in `low` or `high`")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the share that gets in."""
    rows = window(trajectory, given.window_s)
    ends = cloud(trajectory, given.parts, (rows.start, rows.stop - 1))
    before, after = inside(ends, given.low, given.high)
    share = float((after & ~before).mean())
    message = f"{share:.1%} of {given.told()} gets in; {after.mean():.1%} is there in the end"
    return at_least(share, given.min_share, "1", message)


GOOD = ((lambda: crowd(1.0, shift=1.0), {"parts": "grain_*", "low": [0.8, None, None], "min_share": 1.0}),)
BAD = (
    (lambda: crowd(1.0, shift=1.0), {"parts": "grain_*", "low": [0.99, None, None], "min_share": 0.8}),
    (lambda: crowd(1.0), {"parts": "grain_*", "low": [-1, None, None], "min_share": 0.1}),
)
