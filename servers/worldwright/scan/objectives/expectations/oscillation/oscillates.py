"""A body or a joint swings to and fro.

Counts swings whose turning points are at least twice the amplitude apart; two of them are a cycle.
Source: kinematics of oscillations.
"""

from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding, swinging
from ....measuring.channels import OfSignal
from ....measuring.curves import turning_points
from ....measuring.measured import Measured, UnknowableError, at_least, one_of, window

CODE = "WE180"
EVENT = True


class Given(OfSignal):
    """The body or joint, the number of cycles, and the amplitude."""

    min_cycles: float = Field(gt=0, description="least number of cycles")
    min_amplitude_m: float | None = Field(None, gt=0, description="least amplitude of a body or slide, m; or")
    min_amplitude_deg: float | None = Field(None, gt=0, description="least amplitude of a hinge, deg")

    @model_validator(mode="after")
    def _amplitude(self) -> "Given":
        one_of(self, "min_amplitude_m", "min_amplitude_deg")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of cycles."""
    channel = given.channel(trajectory, window(trajectory, given.window_s, 3))
    least = given.min_amplitude_deg if channel.unit == "deg" else given.min_amplitude_m
    if least is None:
        wanted = "min_amplitude_deg" if channel.unit == "deg" else "min_amplitude_m"
        raise UnknowableError(f"{channel.name} is measured in {channel.unit}", next_move=f"give {wanted}")
    turns = turning_points(channel.values, 2 * least)
    span = float(channel.values.max() - channel.values.min())
    cycles = (len(turns) + 1) / 2 if len(turns) else 0.5 * (span >= 2 * least)
    message = f"{channel.name} swings {cycles:g} times by at least {least:g} {channel.unit}, over {span:.4g} in all"
    return at_least(cycles, given.min_cycles, "cycles", message)


GOOD = (  # a pendulum of 1 m takes 2 s: two cycles in 4.1 s, 0.34 m to either side
    (lambda: swinging(1.0, 20.0, seconds=4.1), {"body": "bob", "min_cycles": 2, "min_amplitude_m": 0.34}),
)
BAD = (
    (lambda: swinging(1.0, 20.0, seconds=4.1), {"body": "bob", "min_cycles": 2, "min_amplitude_m": 0.35}),
    (lambda: swinging(1.0, 20.0, seconds=4.1), {"body": "bob", "min_cycles": 3, "min_amplitude_m": 0.3}),
    (sliding, {"body": "body", "min_cycles": 1, "min_amplitude_m": 0.01}),
)
