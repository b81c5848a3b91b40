"""A law over several bodies: one quantity goes as a power of another.

Fits y = c x^n by least squares in logarithms over the bodies and measures the exponent n. The condition x is a property
of each body, or `values` in the bodies' order. Fall time goes as h^(1/2), stopping distance as v^2, a pendulum's period
as l^(1/2), none of them with the mass (n = 0). Source: dimensional analysis; Galileo; power-law regression.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from .....model.recording.trajectory import Trajectory
from ....known.analytic import sliding
from ....known.motions import two
from ....measuring.curves import polynomial
from ....measuring.measured import Measured, Name, UnknowableError, Windowed, body_index, window
from ...quantities import CONDITIONS, OUTCOMES

CODE = "WE285"


class Given(Windowed):
    """The bodies, the two quantities, and the exponent of the law."""

    bodies: tuple[Name, ...] = Field(min_length=2, description="the bodies, two at least")
    of: Literal[
        "max_speed", "mean_speed", "final_speed", "max_spin", "max_height", "min_height", "final_height",
        "rise", "drop", "displacement", "path", "rest_time", "contact_time", "period",
    ] = Field(description="the quantity y; times count from the start of the window")  # fmt: skip
    with_: Literal["mass", "size", "start_height", "start_speed", "start_spin"] | None = Field(
        None, alias="with", description="the condition x, a property of each body; or"
    )
    values: tuple[float, ...] = Field((), description="the condition x, one positive number for each body")
    exponent: float = Field(description="expected exponent n; 0: it does not depend on x")
    tolerance: float = Field(default=0.1, gt=0, description="of the exponent, absolute")

    @model_validator(mode="after")
    def _condition(self) -> "Given":
        if (self.with_ is None) == (not self.values):
            raise ValueError("give `with` or `values`, one of them")
        if self.values and (len(self.values) != len(self.bodies) or min(self.values) <= 0):
            raise ValueError("give one positive value for each body, in the same order")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the exponent."""
    rows = window(trajectory, given.window_s)
    bodies = [body_index(trajectory, name) for name in given.bodies]
    y = np.array([OUTCOMES[given.of][1](trajectory, b, rows) for b in bodies])
    x = np.array(given.values or [CONDITIONS[given.with_ or "mass"][1](trajectory, b, rows) for b in bodies])
    if min(x.min(), y.min()) <= 0:
        raise UnknowableError(
            f"a power law needs positive numbers, these are {x.round(6).tolist()}, {y.round(6).tolist()}"
        )
    if np.ptp(np.log(x)) < 1e-6:
        raise UnknowableError("all bodies have the same condition, so nothing can be told of how it matters")
    order = np.argsort(x)
    steps = np.log(x[order])
    exponent = float(polynomial(steps, np.log(y[order]), 1)[0][1, 0])
    pairs = ", ".join(f"{x[k]:.4g}: {y[k]:.4g}" for k in order[:6])
    message = (
        f"{given.of.replace('_', ' ')} goes as the power {exponent:.3f} of {given.with_ or 'the values'} ({pairs})"
    )
    expected = f"{given.exponent:g} within {given.tolerance:g}"
    return Measured(exponent, expected, given.tolerance - abs(exponent - given.exponent), "1", message)


def braked() -> Trajectory:
    """`a` and `b` braked alike from 2 and 1 m/s: 2 m and 0.5 m."""
    return two(sliding(2.0, 1.0, seconds=2.5), sliding(1.0, 1.0, seconds=2.5))


LAW = {"bodies": ["a", "b"], "of": "path", "with": "start_speed"}
GOOD = (
    (braked, {**LAW, "exponent": 2, "tolerance": 0.01}),
    (braked, {"bodies": ["a", "b"], "of": "rest_time", "values": [2, 1], "exponent": 1, "tolerance": 0.03}),
)
BAD = ((braked, {**LAW, "exponent": 1}), (braked, {**LAW, "exponent": 0}))
