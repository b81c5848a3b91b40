"""Whether a body moves at all, by one measure for every server.

The threshold is 2 % of the bounding radius, or 2 degrees: smaller changes cannot be seen.
"""

import numpy as np

from worldkit.turning import angles_between

from .trajectory import Trajectory

SIZE_FRACTION = 0.02
TURN_RAD = np.radians(2.0)


def travel(trajectory: Trajectory, body: int) -> tuple[float, float]:
    """How far a body gets from its first position (m) and orientation (rad)."""
    away = trajectory.pos[:, body] - trajectory.pos[0, body]
    turned = angles_between(trajectory.quat[:, body], trajectory.quat[0, body])
    return float(np.sqrt((away**2).sum(axis=1)).max()), float(turned.max())


def least_m(trajectory: Trajectory, body: int) -> float:
    """The distance from which on a body counts as moved, m."""
    return SIZE_FRACTION * float(trajectory.size_m[body])


def stays_put(trajectory: Trajectory, body: int) -> bool:
    """Whether neither the body's place nor its orientation ever changes by more than the threshold."""
    moved, turned = travel(trajectory, body)
    return moved < least_m(trajectory, body) and turned < TURN_RAD
