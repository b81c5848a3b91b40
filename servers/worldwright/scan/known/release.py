"""A spring lets go."""

from typing import Any

import numpy as np

from ...model.recording.trajectory import Trajectory
from .analytic import G, clock, motion


def released(
    stiffness: float = 200.0,
    compression: float = 0.1,
    mass: float = 1.0,
    lost: float = 0.0,
    seconds: float = 1.0,
    **more: Any,
) -> Trajectory:
    """A body on a pressed spring along x: v = x sqrt(k / m) once the spring is slack, less the share of energy `lost`.

    The recorded energy holds the spring's: E_pot = k (x - s)^2 / 2 + m g z, until the body has gone the way x.
    """
    t = clock(seconds)
    w, keeps = np.sqrt(stiffness / mass), np.sqrt(1 - lost)
    free = np.pi / 2 / w
    pressed = t < free
    way = np.where(pressed, compression * (1 - np.cos(w * t)), compression + keeps * compression * w * (t - free))
    v = np.where(pressed, compression * w * np.sin(w * t), compression * w) * keeps
    left = np.where(pressed, compression * np.cos(w * t), 0.0)
    pos = np.stack([way, 0 * t, 0 * t + 1.0], axis=1)
    vel = np.stack([v, 0 * t, 0 * t], axis=1)
    energy = np.stack([stiffness * left**2 / 2 + mass * G * 1.0, mass * v**2 / 2], axis=1)
    return motion(t, pos, vel, mass=mass, energy=energy, free=False, **more)
