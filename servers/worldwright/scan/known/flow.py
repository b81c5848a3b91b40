"""Bodies in water, and crowds of grains."""

from typing import Any

import numpy as np

from ...model.recording.trajectory import Trajectory
from .analytic import Touch, clock, motion

Array = np.ndarray


def floating(
    share: float = 0.6, surface: float = 1.0, size: float = 0.2, start: float = 0.3, seconds: float = 6.0, **more: Any
) -> Trajectory:
    """A box that bobs and comes to float with `share` of its volume under the surface, released `start` above that height.

    z = surface + (1/2 - share) size + start exp(-2 t) cos(6 t). Source: Archimedes; the damped oscillator.
    """
    t = clock(seconds)
    fade = start * np.exp(-2 * t)
    z = surface + (0.5 - share) * size + fade * np.cos(6 * t)
    v = -fade * (2 * np.cos(6 * t) + 6 * np.sin(6 * t))
    pos = np.stack([0 * t, 0 * t, z], axis=1)
    return motion(t, pos, np.stack([0 * t, 0 * t, v], axis=1), size_m=size, ground_z=None, **more)


def sinking(
    speed: float = 0.4, surface: float = 1.0, size: float = 0.2, seconds: float = 3.0, **more: Any
) -> Trajectory:
    """A box that starts half under the surface and sinks evenly to the bottom at z = 0 (or rises, for a negative speed)."""
    t = clock(seconds)
    z = np.maximum(surface - speed * t, size / 2)
    v = np.where(z > size / 2, -speed, 0.0)
    pos = np.stack([0 * t, 0 * t, z], axis=1)
    return motion(t, pos, np.stack([0 * t, 0 * t, v], axis=1), size_m=size, **more)


def crowd(
    growth: float = 3.0, shift: float = 0.0, until: float = 1.0, seconds: float = 2.0, count: int = 25, **more: Any
) -> Trajectory:
    """Grains `grain_0` … on a square of 0.2 m that grows `growth` times and moves by `shift` along x until `until`."""
    t = clock(seconds)
    side = round(np.sqrt(count))
    grid = np.linspace(-0.1, 0.1, side)
    flat = np.array([(x, y, 0.0) for x in grid for y in grid])
    share = np.minimum(t / until, 1.0)[:, None, None]
    rate = np.where(t < until, 1 / until, 0.0)[:, None, None]
    way = np.array([shift, 0.0, 0.0])
    pos = flat * (1 + (growth - 1) * share) + share * way + np.array([0.0, 0.0, 0.01])
    vel = (flat * (growth - 1) + way) * rate
    names = tuple(f"grain_{k}" for k in range(len(flat)))
    touches: list[Touch] = [(-1, k, np.ones(len(t), dtype=bool), 1e-5, 0.01) for k in range(len(flat))]
    return motion(t, pos, vel, names=names, size_m=0.02, touches=touches, **more)


def stream(
    per_s: float = 20.0, seconds: float = 2.0, pause_s: tuple[float, float] = (0.0, 0.0), **more: Any
) -> Trajectory:
    """Grains `drop_0` … of 10 g that come down at 1 m/s, one after the other at `per_s`, none within `pause_s`.

    Drop k passes z = 0 at (k + 1/2) / per_s. Source: kinematics.
    """
    t = clock(seconds)
    moments = (np.arange(int(per_s * seconds)) + 0.5) / per_s
    moments = moments[(moments < pause_s[0]) | (moments > pause_s[1])]
    pos = np.zeros((len(t), len(moments), 3))
    pos[:, :, 2] = moments - t[:, None]
    vel = np.tile((0.0, 0.0, -1.0), (len(t), len(moments), 1))
    names = tuple(f"drop_{k}" for k in range(len(moments)))
    return motion(t, pos, vel, names=names, size_m=0.01, mass=0.01, ground_z=None, **more)
