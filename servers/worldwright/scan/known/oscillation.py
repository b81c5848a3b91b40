"""Springs and pairs of pendulums."""

from typing import Any

import numpy as np

from ...model.recording.trajectory import Trajectory
from .analytic import clock, motion


def springing(
    stiffness: float = 40.0,
    mass: float = 1.0,
    ratio: float = 0.0,
    amplitude: float = 0.1,
    seconds: float = 5.0,
    **more: Any,
) -> Trajectory:
    """A mass on a spring along x, let go at `amplitude`: x = A exp(-z w t) (cos wd t + z w / wd sin wd t).

    w = sqrt(k / m), wd = w sqrt(1 - z^2). Source: the damped harmonic oscillator.
    """
    t = clock(seconds)
    w = np.sqrt(stiffness / mass)
    damped = w * np.sqrt(1 - ratio**2)
    fading = amplitude * np.exp(-ratio * w * t)
    x = fading * (np.cos(damped * t) + ratio * w / damped * np.sin(damped * t))
    v = -fading * np.sin(damped * t) * (damped + (ratio * w) ** 2 / damped)
    pos = np.stack([x, 0 * t, 0 * t + 1.0], axis=1)
    return motion(t, pos, np.stack([v, 0 * t, 0 * t], axis=1), mass=mass, free=False, gravity=0.0, **more)


def pair(
    phase_deg: float = 0.0, period: float = 1.0, detuned: float = 0.0, seconds: float = 4.0, **more: Any
) -> Trajectory:
    """Two bodies `a` and `b` swinging along x: cos(2 pi t / T), and cos(2 pi t / T (1 + d) + phase)."""
    t = clock(seconds)
    w = 2 * np.pi / period * np.array([1.0, 1.0 + detuned])
    angle = w * t[:, None] + np.radians([0.0, phase_deg])
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    pos[:, :, 0], vel[:, :, 0] = 0.1 * np.cos(angle), -0.1 * w * np.sin(angle)
    pos[:, 1, 1] = 1.0
    return motion(t, pos, vel, names=("a", "b"), free=False, gravity=0.0, **more)


def beating(period: float = 0.5, beat: float = 4.0, seconds: float = 4.0, **more: Any) -> Trajectory:
    """Two equal, weakly coupled oscillators `a` and `b`, one started: the motion wanders over and back.

    x1 = A cos(d t) cos(w t), x2 = A sin(d t) sin(w t), with the whole energy in `b` after half a beat.
    Source: coupled oscillators, normal modes.
    """
    t = clock(seconds)
    w, d = 2 * np.pi / period, np.pi / beat
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    pos[:, 0, 0] = 0.1 * np.cos(d * t) * np.cos(w * t)
    pos[:, 1, 0] = 0.1 * np.sin(d * t) * np.sin(w * t)
    vel[:, 0, 0] = -0.1 * (d * np.sin(d * t) * np.cos(w * t) + w * np.cos(d * t) * np.sin(w * t))
    vel[:, 1, 0] = 0.1 * (d * np.cos(d * t) * np.sin(w * t) + w * np.sin(d * t) * np.cos(w * t))
    pos[:, 1, 1] = 1.0
    return motion(t, pos, vel, names=("a", "b"), free=False, gravity=0.0, **more)
