"""Bodies that spin, precess and tumble, by closed formulas."""

from typing import Any

import numpy as np

from worldkit.turning import about, product

from ...model.recording.trajectory import Trajectory
from .analytic import G, clock, motion


def spinning(rate: float = 10.0, slowing: float = 0.0, seconds: float = 2.0, **more: Any) -> Trajectory:
    """A body turning about +z on the spot, at w = w0 - k t until it stops."""
    t = clock(seconds)
    s = np.minimum(t, rate / slowing) if slowing > 0 else t
    angle = rate * s - slowing * s**2 / 2
    spin = np.stack([0 * t, 0 * t, rate - slowing * s], axis=1)
    pos = np.tile((0.0, 0.0, 0.05), (len(t), 1))
    return motion(
        t, pos, np.zeros_like(pos), quat=about((0, 0, 1), angle)[:, None], angvel=spin[:, None], gravity=0.0, **more
    )


def precessing(
    spin: float = 100.0, arm: float = 0.05, tilt_deg: float = 30.0, seconds: float = 2.0, size: float = 0.1, **more: Any
) -> Trajectory:
    """A fast top on a point at (0, 0, 1 m): its axis goes round the vertical at W = m g d / (I w).

    The body is a solid ball (I = 2/5 m r^2) whose centre is `arm` from the point. Source: steady precession of a heavy
    symmetric top in the limit of fast spin.
    """
    t = clock(seconds)
    rate = G * arm / (0.4 * (size / 2) ** 2 * spin)
    tilt = np.radians(tilt_deg)
    axis = np.stack([np.sin(tilt) * np.cos(rate * t), np.sin(tilt) * np.sin(rate * t), 0 * t + np.cos(tilt)], axis=1)
    own = spin - rate * np.cos(tilt)  # so that the whole angular velocity has the component `spin` along the axis
    turn = product(about((0, 0, 1), rate * t), about((0, 1, 0), tilt))
    quat = product(turn, about((0, 0, 1), own * t))
    angvel = own * axis + np.array([0.0, 0.0, rate])
    pos = np.array([0.0, 0.0, 1.0]) + arm * axis
    vel = arm * np.cross(angvel, axis)
    return motion(t, pos, vel, quat=quat[:, None], angvel=angvel[:, None], size_m=size, free=False, **more)
