"""A force stays the same over a window: a constant pull, a steady grip.

Measures the largest deviation of the force from `n` (without it: from its mean) over the window, relative. Short windows
average over `smooth_s`, since contact forces chatter from step to step. Source: the engine's forces; statics.
"""

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import G, resting
from ....known.structures import breaking
from ....measuring.forces import Load
from ....measuring.measured import Measured, Tolerance, UnknowableError, Windowed, at_most, window

CODE = "WE150"
LASTING = True


class Given(Windowed):
    """Which force, how steady."""

    force: Load = Field(description="one of {tendon}, {constraint}, {bodies: [a, b]}")
    n: float | None = Field(None, gt=0, description="the force, N; without it its own mean over the window")
    tolerance: Tolerance = Field(description="largest deviation, relative")
    smooth_s: float = Field(0.05, ge=0, description="averaged over so many seconds, s")


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The largest deviation."""
    rows = window(trajectory, given.window_s)
    channel = given.force.channel(trajectory)
    values = channel.values[rows]
    width = min(len(values), max(1, round(given.smooth_s / max(trajectory.interval_s, 1e-9))))
    total = np.concatenate([[0.0], np.cumsum(values)])
    smooth = (total[width:] - total[:-width]) / width
    level = float(values.mean()) if given.n is None else given.n
    if not level > 0:
        raise UnknowableError(f"{channel.name} does not act in the window")
    off = float(np.abs(smooth - level).max() / level)
    message = f"{channel.name} is {smooth.min():.4g} to {smooth.max():.4g} N, {off:.2%} off {level:.4g} N"
    return at_most(off, given.tolerance, "1", message)


ON_GROUND = {"bodies": ["body", "ground"]}
GOOD = (
    (resting, {"force": ON_GROUND, "n": G, "tolerance": 0.01}),
    (lambda: breaking(None), {"force": {"constraint": "pin"}, "tolerance": 0.001}),
)
BAD = (
    (resting, {"force": ON_GROUND, "n": 2 * G, "tolerance": 0.1}),
    (lambda: breaking(None), {"force": {"constraint": "bolt"}, "tolerance": 0.1}),
)
