"""Two bodies, or two joints, swing with a given phase between them: together, or against each other.

Fits both at the period of the first and measures how far the phase of the second is from `phase_deg`, degrees. They must
also have the same period within `tolerance`. Source: the harmonic oscillator; normal modes.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.oscillation import pair
from ....measuring.channels import coordinate, joint
from ....measuring.curves import phasor, swings
from ....measuring.measured import Measured, Name, Tolerance, Windowed, all_of, at_most, close_to, one_of, window

CODE = "WE184"


class Given(Windowed):
    """The two bodies or joints, and the phase between them."""

    bodies: tuple[Name, Name] | None = Field(None, description="two bodies; or")
    joints: tuple[Name, Name] | None = Field(None, description="two hinges or slides")
    along: str = Field(
        "principal", pattern="^(x|y|z|principal)$", description="of bodies: x, y, z, or where they move most"
    )
    phase_deg: float = Field(default=0.0, ge=-180, le=180, description="expected phase, deg: 0 together, 180 against")
    tolerance_deg: float = Field(default=20.0, gt=0, lt=180, description="largest difference of phase, deg")
    tolerance: Tolerance = Field(0.05, description="relative, of their periods")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        one_of(self, "bodies", "joints")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the difference of phase."""
    rows = window(trajectory, given.window_s, 5)
    t = trajectory.t[rows]
    if given.joints:
        signals = [joint(trajectory, name).values[rows] for name in given.joints]
    else:
        signals = [coordinate(trajectory, name, given.along, rows).values for name in given.bodies or ()]
    names = " and ".join(given.joints or given.bodies or ())
    periods = [swings(t, values)[0] for values in signals]
    if periods[0] is None or periods[1] is None:
        return at_most(180.0, given.tolerance_deg, "deg", f"{names} do not both swing")
    phases = [np.degrees(phasor(t, values, periods[0])[1]) for values in signals]
    lag = float((phases[1] - phases[0] + 180) % 360 - 180)
    off = abs(float((lag - given.phase_deg + 180) % 360 - 180))
    message = f"{names} swing {lag:+.1f} degrees apart, with periods of {periods[0]:.4f} and {periods[1]:.4f} s"
    return all_of(
        at_most(off, given.tolerance_deg, "deg", message),
        close_to(periods[1], periods[0], given.tolerance, "s", f"{message}: not the same"),
    )


GOOD = (
    (pair, {"bodies": ["a", "b"], "tolerance_deg": 1}),
    (lambda: pair(180.0), {"bodies": ["a", "b"], "phase_deg": 180, "tolerance_deg": 1}),
    (lambda: pair(90.0), {"bodies": ["a", "b"], "phase_deg": 90, "along": "x", "tolerance_deg": 1}),
)
BAD = (
    (lambda: pair(180.0), {"bodies": ["a", "b"]}),
    (lambda: pair(45.0), {"bodies": ["a", "b"]}),
    (lambda: pair(detuned=0.2), {"bodies": ["a", "b"], "tolerance_deg": 179}),
)
