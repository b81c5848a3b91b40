"""A body spins ever slower: a top on its peg, a coin, a wheel that runs out.

Measures its angular speed, or with `axis` that about its own axis: the share of the first rate that it has lost where it is
slowest (`min_share`), the first and the slowest rate (`from_rad_s`, `to_rad_s`), and the mean slowing, the slope of a straight line
through the window (`slowing_rad_s2`). It may not gain more than `max_rise` of its first rate between. Friction of a torque
T slows it by T / I, down a straight line; that of a contact is torsional * m g. Source: Euler's equations; Coulomb friction.
"""

from typing import Literal

import numpy as np
from pydantic import Field, model_validator

from worldkit.turning import matrices

from .....model.recording.trajectory import Trajectory
from ....known.analytic import resting
from ....known.rotation import spinning
from ....measuring.measured import Measured, OfBody, all_of, at_least, at_most, body_index, close_to, window

CODE = "WE168"
EVENT = True
STILL_RAD_S = 1e-6
AXES = {"x": 0, "y": 1, "z": 2}


class Given(OfBody):
    """The body, and by how much or how fast it slows."""

    axis: Literal["x", "y", "z"] | None = Field(
        None, description="own axis of the body; without it the whole rate counts"
    )
    min_share: float | None = Field(None, gt=0, le=1, description="least share of its first rate that it loses")
    from_rad_s: float | None = Field(None, gt=0, description="its first rate, within the tolerance, rad/s")
    to_rad_s: float | None = Field(None, ge=0, description="largest of its slowest rate, rad/s")
    slowing_rad_s2: float | None = Field(None, gt=0, description="mean slowing, within the tolerance, rad/s^2")
    tolerance: float = Field(0.1, gt=0, description="relative, of `from_rad_s` and `slowing_rad_s2`")
    max_rise: float = Field(0.1, ge=0, description="largest gain between, as a share of its first rate")

    @model_validator(mode="after")
    def _asked(self) -> "Given":
        if (self.min_share, self.to_rad_s, self.slowing_rad_s2) == (None, None, None):
            raise ValueError("give min_share, to_rad_s or slowing_rad_s2")
        return self


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure how it slows."""
    rows, body = window(trajectory, given.window_s, 2), body_index(trajectory, given.body)
    rate = trajectory.spin[rows, body]
    if given.axis is not None:
        own = matrices(trajectory.quat[rows, body])[:, :, AXES[given.axis]]
        rate = np.abs((trajectory.angvel[rows, body] * own).sum(axis=1))
    first, slowest = float(rate[0]), float(rate.min())
    if first < STILL_RAD_S:
        return at_least(0.0, given.min_share or 1.0, "1", f"{given.body} does not spin at the start of the window")
    lost, t = 1 - slowest / first, trajectory.t[rows]
    slowing = -float(np.polyfit(t - t[0], rate, 1)[0])
    rise = float((rate - np.minimum.accumulate(rate)).max() / first)
    message = (
        f"{given.body} slows from {first:.3f} to {slowest:.3f} rad/s, by {lost:.1%}, {slowing:.3f} rad/s^2 on average"
    )
    conditions = []
    if given.min_share is not None:
        conditions.append(at_least(lost, given.min_share, "1", message))
    if given.to_rad_s is not None:
        conditions.append(at_most(slowest, given.to_rad_s, "rad/s", message))
    if given.slowing_rad_s2 is not None:
        conditions.append(close_to(slowing, given.slowing_rad_s2, given.tolerance, "rad/s^2", message))
    if given.from_rad_s is not None:
        conditions.append(close_to(first, given.from_rad_s, given.tolerance, "rad/s", message))
    return all_of(*conditions, at_most(rise, given.max_rise, "1", f"{given.body} gains {rise:.1%} of its spin again"))


GOOD = (
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "min_share": 0.39, "from_rad_s": 10, "to_rad_s": 6.01}),
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "axis": "z", "slowing_rad_s2": 2.0, "tolerance": 0.001}),
)
BAD = (
    (spinning, {"body": "body", "min_share": 0.01}),
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "to_rad_s": 5.9}),
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "slowing_rad_s2": 3.0}),
    (lambda: spinning(10.0, slowing=2.0), {"body": "body", "axis": "x", "min_share": 0.5}),
    (resting, {"body": "body", "min_share": 0.5}),
)
