"""A body bounces at least so often, each time lower when `decays` is asked for.

A bounce is an impact: in contact (or with a jump of velocity that gravity cannot make), the body turns from downward to
upward and then rises by at least `min_rise_m`. The height of a bounce is the apex after it, above the lowest point;
with restitution e, apex k is e^2 times apex k-1. Source: elementary collision theory (Newton's restitution).
"""

from itertools import pairwise

import numpy as np
from pydantic import Field

from .....model.recording.trajectory import Trajectory
from ....known.analytic import bouncing, falling
from ....known.motions import thrown
from ....measuring.curves import turning_points
from ....measuring.measured import Measured, OfBody, body_index, window

CODE = "WE107"
EVENT = True
NEAR_ROWS = 3
JUMP = 5.0
"""An impact changes the velocity by so many times as much as gravity does from row to row."""


class Given(OfBody):
    """The body, the number of bounces, and whether they decay."""

    min_count: int = Field(ge=1, description="least number of bounces")
    decays: bool = Field(default=False, description="whether each apex must be lower than the one before")
    min_rise_m: float = Field(default=0.005, gt=0, description="what counts as a bounce, m")


def apexes(trajectory: Trajectory, body: int, rows: slice, rise: float) -> list[float]:
    """The height of the top after each impact, above the lowest point before it, m."""
    height, climb = trajectory.pos[rows, body, 2], trajectory.linvel[rows, body, 2]
    hit = np.zeros(len(height), dtype=bool)
    if trajectory.touching is not None:
        hit |= trajectory.touching[rows, body]
    usual = JUMP * max(float(np.linalg.norm(trajectory.gravity)), 1e-9) * trajectory.interval_s
    hit[1:] |= np.abs(np.diff(climb)) > usual
    turns = turning_points(height, rise)
    found = []
    for k, low in enumerate(turns):
        stop = turns[k + 1] + 1 if k + 1 < len(turns) else len(height)
        top = float(height[low:stop].max() - height[low])
        if top >= rise and hit[max(0, low - NEAR_ROWS) : low + NEAR_ROWS + 1].any():
            found.append(top)
    return found


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """Measure the number of bounces, and whether they get lower."""
    body = body_index(trajectory, given.body)
    tops = apexes(trajectory, body, window(trajectory, given.window_s), given.min_rise_m)
    margin = float(len(tops) - given.min_count)
    heights = ", ".join(f"{top:.3f}" for top in tops[:6])
    message = f"{given.body} bounces {len(tops)} times, up to {heights} m" if tops else f"{given.body} does not bounce"
    if given.decays and margin >= 0:
        rises = [later - earlier for earlier, later in pairwise(tops)]
        worst = max(rises, default=0.0)
        if worst >= 0 and rises:
            bounce = rises.index(worst) + 2
            message += f"; bounce {bounce} is not lower than the one before"
            return Measured(float(len(tops)), "each bounce lower", -max(worst, 1e-9), "m", message)
    return Measured(float(len(tops)), f"at least {given.min_count} bounces", margin, "bounces", message)


GOOD = ((lambda: bouncing(1.0, 0.8), {"body": "ball", "min_count": 4, "decays": True}),)
BAD = (
    (lambda: bouncing(1.0, 0.8), {"body": "ball", "min_count": 40}),
    (lambda: bouncing(1.0, 1.0), {"body": "ball", "min_count": 2, "decays": True}),
    (lambda: falling(seconds=0.3, touches=[]), {"body": "body", "min_count": 1}),
    (lambda: thrown((0, 0, 3.0), seconds=0.6), {"body": "body", "min_count": 1}),
)
