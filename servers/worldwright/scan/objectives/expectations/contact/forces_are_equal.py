"""Two or more forces are equal over a window: a rope's two ends, the feet of a table, a load shared.

Measures (largest - least) / mean of their means over the window. A force is the tension of a tendon, the load of a
constraint, or what two bodies push on each other with. `ratios` says how many times the first each is (a pulley block).
Source: statics; Newton's third law.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.structures import breaking, with_channels
from ....measuring.forces import Load
from ....measuring.measured import Measured, Tolerance, UnknowableError, Windowed, at_most, window

CODE = "WE149"
LASTING = True


class Given(Windowed):
    """Which, how nearly."""

    forces: tuple[Load, ...] = Field(min_length=2, description="each one of {tendon}, {constraint}, {bodies: [a, b]}")
    ratios: tuple[float, ...] = Field(
        (), description="what each is of the first, e.g. [1, 2]; without it all are equal"
    )
    tolerance: Tolerance = Field(description="largest difference, relative to their mean")

    @model_validator(mode="after")
    def _paired(self) -> "Given":
        if self.ratios and (len(self.ratios) != len(self.forces) or not all(r > 0 for r in self.ratios)):
            raise ValueError(f"`ratios` are {len(self.forces)} positive numbers, one for each of `forces`")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The largest difference."""
    rows = window(trajectory, given.window_s)
    channels = [load.channel(trajectory) for load in given.forces]
    means = np.array([channel.values[rows].mean() for channel in channels])
    shares = means / np.array(given.ratios or (1.0,) * len(means))
    told = ", ".join(f"{channel.name} {mean:.4g} N" for channel, mean in zip(channels, means, strict=True))
    if not shares.mean() > 0:
        raise UnknowableError(f"none of the forces acts: {told}")
    return at_most(float(np.ptp(shares) / shares.mean()), given.tolerance, "1", f"on average {told}")


def _two_ropes(other: float = 10.0):
    body = resting()
    still = 0 * body.t + 1
    return with_channels(body, tendons={"left": (still, 10.0 * still), "right": (still, other * still)})


ROPES = [{"tendon": "left"}, {"tendon": "right"}]
GOOD = (
    (_two_ropes, {"forces": ROPES, "tolerance": 0.01}),
    (lambda: _two_ropes(20.0), {"forces": ROPES, "ratios": [1, 2], "tolerance": 0.01}),
    (lambda: _two_ropes(9.80665), {"forces": [ROPES[1], {"bodies": ["body", "ground"]}], "tolerance": 0.001}),
)
BAD = (
    (lambda: _two_ropes(12.0), {"forces": ROPES, "tolerance": 0.1}),
    (lambda: breaking(None), {"forces": [{"constraint": "bolt"}, {"constraint": "pin"}], "tolerance": 0.1}),
)
