"""A spinning body precesses: its axis goes round the vertical.

Measures the mean rate of the azimuth of the body's own axis, rad/s, counter-clockwise from above. `rate_rad_s` gives the
rate to expect; `arm_m` takes it from theory instead, W = m g d / (I w), with the recorded mass, inertia and spin; with
neither, the axis must only go round `min_turns` times. The tilt must not change by more than `max_nod_deg`.
Source: the heavy symmetric top in steady precession (fast spin).
"""

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.closed_forms import precession_rate
from .....model.recording.trajectory import Trajectory
from ....known.rotation import precessing, spinning
from ....measuring.channels import AXES, direction_of
from ....measuring.curves import polynomial
from ....measuring.measured import (
    Measured,
    OfBody,
    Tolerance,
    UnknowableError,
    all_of,
    at_least,
    at_most,
    body_index,
    close_to,
    masses,
    window,
)

CODE = "WE161"
EVENT = True


class Given(OfBody):
    """The body, the rate to expect, and the tolerance."""

    axis: str = Field("z", pattern="^[xyz]$", description="the body's own axis of spin: x, y or z")
    rate_rad_s: float | None = Field(None, description="expected rate, rad/s, counter-clockwise from above; or")
    arm_m: float | None = Field(
        None, gt=0, description="distance of its centre of mass from the pivot, m: theory's rate"
    )
    tolerance: Tolerance = Field(0.1, description="relative, of the rate")
    min_turns: float = Field(default=0.5, gt=0, description="least angle passed about the vertical, turns")
    max_nod_deg: float = Field(default=15.0, gt=0, description="largest change of the tilt, deg")

    @model_validator(mode="after")
    def _one(self) -> "Given":
        if self.rate_rad_s is not None and self.arm_m is not None:
            raise ValueError("give rate_rad_s or arm_m, not both")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the rate of precession."""
    rows = window(trajectory, given.window_s, 5)
    axis, t = direction_of(trajectory, given, given.axis), trajectory.t[rows]
    tilt = np.degrees(np.arccos(np.clip(axis[:, 2], -1, 1)))
    upright = np.hypot(axis[:, 0], axis[:, 1]).max()
    if upright < 1e-6:
        return at_least(0.0, given.min_turns, "turns", f"the axis of {given.body} stands upright and goes nowhere")
    azimuth = np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]))
    rate = float(polynomial(t, azimuth, 1)[0][1, 0])
    turns = float(np.abs(azimuth - azimuth[0]).max() / (2 * np.pi))
    nod = float(np.ptp(tilt))
    message = f"the axis of {given.body} goes round at {rate:.4f} rad/s ({turns:.2f} turns), its tilt changes by {nod:.1f} degrees"
    conditions = [at_least(turns, given.min_turns, "turns", message), at_most(nod, given.max_nod_deg, "deg", message)]
    expected = given.rate_rad_s if given.arm_m is None else _theory(trajectory, given, rows, axis)
    if expected is not None:
        conditions.insert(0, close_to(rate, expected, given.tolerance, "rad/s", message))
    return all_of(*conditions)


def _theory(trajectory: Trajectory, given: Given, rows: slice, axis: np.ndarray) -> float:
    body, facts = body_index(trajectory, given.body), trajectory.mechanics
    if facts.inertia is None:
        raise UnknowableError("the recording does not tell inertias", next_move="give rate_rad_s instead of arm_m")
    own = np.eye(3)[AXES[given.axis]]
    if facts.inertia_quat is not None:
        own = matrices(facts.inertia_quat[body]).T @ own
    inertia = float(facts.inertia[body] @ own**2)
    spin = float((trajectory.angvel[rows, body] * axis).sum(axis=1).mean())
    mass, g = float(masses(trajectory)[body]), float(np.linalg.norm(trajectory.gravity))
    return precession_rate(mass, given.arm_m or 0.0, inertia, spin, g) if spin else np.inf


TOP = 9.80665 * 0.05 / (0.4 * 0.05**2 * 100.0)
GOOD = (
    (precessing, {"body": "body", "rate_rad_s": TOP, "tolerance": 0.001, "min_turns": 1.5}),
    (precessing, {"body": "body", "arm_m": 0.05, "tolerance": 0.01}),
)
BAD = (
    (precessing, {"body": "body", "rate_rad_s": -TOP}),
    (lambda: precessing(spin=200.0), {"body": "body", "rate_rad_s": TOP}),
    (lambda: precessing(spin=2000.0), {"body": "body"}),
    (spinning, {"body": "body"}),
)
