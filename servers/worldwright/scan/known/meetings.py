"""Bodies that meet and stay together."""

from typing import Any

import numpy as np

from ...model.recording.closed_forms import fall_time
from ...model.recording.trajectory import Trajectory
from .analytic import G, Touch, clock, motion


def caught(height: float = 1.0, seconds: float = 1.5, slips: float = 0.0, **more: Any) -> Trajectory:
    """A ball dropped from `height` above a box on the ground, where it stays: a perfectly inelastic landing.

    It lands after sqrt(2 h / g). With `slips` (m) it then creeps upwards by so much until the end.
    """
    t = clock(seconds)
    land = fall_time(height, G)
    flying = t < land
    z = np.where(flying, 0.3 + height - G * t**2 / 2, 0.3 + slips * (t - land) / (seconds - land))
    v = np.where(flying, -G * t, slips / (seconds - land))
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    pos[:, 0, 2], pos[:, 1, 2], vel[:, 0, 2] = z, 0.1, v
    always = np.ones(len(t), dtype=bool)
    touches: list[Touch] = [(-1, 1, always, 1e-5, 2 * G), (1, 0, ~flying, 1e-5, G)]
    return motion(t, pos, vel, names=("ball", "box"), size_m=0.2, touches=touches, **more)
