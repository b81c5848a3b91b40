"""An oscillation has the period that theory gives.

Measures the mean time between passages through the midline in the same sense, seconds. Theory: `period_s` as given;
`pendulum_m` T = 2 pi sqrt(l / g), times 1 + a^2/16 + 11 a^4/3072 for a swing of `amplitude_deg`; `stiffness_n_m`
T = 2 pi sqrt(m / k) with `mass_kg` or the body's own mass. Source: the harmonic oscillator; the simple pendulum's
series for finite amplitudes.
"""

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.closed_forms import pendulum_period, spring_period
from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding, swinging
from ....known.oscillation import springing
from ....measuring.channels import OfSignal
from ....measuring.curves import swings
from ....measuring.measured import (
    Measured,
    Tolerance,
    UnknowableError,
    at_least,
    body_index,
    close_to,
    masses,
    one_of,
    window,
)

CODE = "WE181"


class Given(OfSignal):
    """The body or joint, the period to expect, and the tolerance."""

    period_s: float | None = Field(None, gt=0, description="expected period, s; or")
    pendulum_m: float | None = Field(None, gt=0, description="length of a simple pendulum, m; or")
    stiffness_n_m: float | None = Field(None, gt=0, description="stiffness of a spring, N/m")
    mass_kg: float | None = Field(None, gt=0, description="with a spring: the mass on it, kg; else the body's own")
    amplitude_deg: float = Field(default=0.0, ge=0, lt=120, description="with a pendulum: its amplitude, deg")
    tolerance: Tolerance = Field(0.02, description="relative")

    @model_validator(mode="after")
    def _theory(self) -> "Given":
        one_of(self, "period_s", "pendulum_m", "stiffness_n_m")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the mean period."""
    rows = window(trajectory, given.window_s, 5)
    channel = given.channel(trajectory, rows)
    period, _ = swings(trajectory.t[rows], channel.values)
    expected = _expected(trajectory, given)
    if period is None:
        return at_least(0.0, expected, "s", f"{channel.name} does not swing to and fro even once")
    message = f"{channel.name} swings with a period of {period:.4f} s, theory says {expected:.4f} s"
    return close_to(period, expected, given.tolerance, "s", message)


def _expected(trajectory: Trajectory, given: Given) -> float:
    if given.period_s:
        return given.period_s
    if given.pendulum_m:
        g = float(np.linalg.norm(trajectory.gravity))
        if g == 0:
            raise UnknowableError("a pendulum needs gravity, this recording has none")
        return pendulum_period(given.pendulum_m, given.amplitude_deg, g)
    mass = given.mass_kg
    if mass is None:
        if not given.body:
            raise UnknowableError("a joint has no mass of its own", next_move="give mass_kg")
        mass = float(masses(trajectory)[body_index(trajectory, given.body)])
    return spring_period(given.stiffness_n_m or 1.0, mass)


GOOD = (
    (lambda: swinging(1.0, 10.0, seconds=5.0), {"body": "bob", "pendulum_m": 1.0, "tolerance": 0.001}),
    (lambda: springing(40.0, 2.0), {"body": "body", "stiffness_n_m": 40, "tolerance": 0.001}),
    (lambda: springing(40.0, 1.0, ratio=0.05), {"body": "body", "period_s": 0.9947, "tolerance": 0.01}),
)
BAD = (
    (lambda: swinging(1.0, 10.0, seconds=5.0), {"body": "bob", "pendulum_m": 1.5}),
    (lambda: springing(40.0, 2.0), {"body": "body", "stiffness_n_m": 40, "mass_kg": 1.0}),
    (sliding, {"body": "body", "period_s": 1.0}),
)
