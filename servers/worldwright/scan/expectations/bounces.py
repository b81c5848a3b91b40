"""A body bounces at least so often, each time lower when `decays` is asked for.

A bounce is an impact: in contact, the vertical speed turns from downward to upward and the body then rises by at least
`min_rise_m` before it falls again. The height of a bounce is the apex after it; with restitution e, apex k is e^2 times
apex k-1. Source: elementary collision theory (Newton's restitution).
"""

from itertools import pairwise

import numpy as np
from pydantic import Field

from ...model.trajectory import Trajectory
from ..analytic import bouncing, falling
from ..measured import Measured, OfBody, body_index, window

CODE = "WE107"


class Given(OfBody):
    """min_count: bounces; decays: each apex lower than the one before; min_rise_m: what counts as a bounce, metres."""

    min_count: int = Field(ge=1)
    decays: bool = False
    min_rise_m: float = Field(default=0.005, gt=0)


def apexes(height: np.ndarray, rise: float) -> list[float]:
    """Heights of the tops after each bounce, measured from the lowest point before it."""
    found, lowest, highest, rising = [], height[0], height[0], False
    for z in height:
        if rising:
            highest = max(highest, z)
            if highest - z >= rise:  # on the way down again: the bounce is complete
                found.append(float(highest - lowest))
                rising, lowest = False, z
        else:
            lowest = min(lowest, z)
            if z - lowest >= rise:
                rising, highest = True, z
    if rising:
        found.append(float(highest - lowest))
    return found


def measure(trajectory: Trajectory, given: Given) -> Measured:
    """The number of bounces, and whether they get lower."""
    body = body_index(trajectory, given.body)
    rows = window(trajectory, given.window_s)
    if trajectory.touching is None or not trajectory.touching[rows, body].any():
        return Measured(
            0, f"at least {given.min_count} bounces", -given.min_count, "bounces", f"{given.body} hits nothing"
        )
    tops = apexes(trajectory.pos[rows, body, 2], given.min_rise_m)
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
)
