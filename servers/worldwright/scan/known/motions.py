"""Points on curves: projectiles, circles, Kepler's ellipses, inclines, falls through a medium."""

from typing import Any

import numpy as np

from ...model.recording.closed_forms import rolling_acceleration, slope_acceleration
from ...model.recording.trajectory import Trajectory
from .analytic import DT, G, Touch, clock, motion


def thrown(
    velocity: tuple[float, float, float], height: float = 1.0, g: float = G, seconds: float = 0.5, **more: Any
) -> Trajectory:
    """A projectile: x = x0 + v t + g t^2 / 2, in a world whose gravity is g."""
    t = clock(seconds)
    v = np.array(velocity)
    fall = np.array([0.0, 0.0, -g])
    pos = np.array([0.0, 0.0, height]) + t[:, None] * v + t[:, None] ** 2 * fall / 2
    return motion(t, pos, v + t[:, None] * fall, gravity=g, **more)


def circling(radius: float = 1.0, speed: float = 1.0, turns: float = 1.0, **more: Any) -> Trajectory:
    """Uniform circular motion about (0, 0, 1 m) in a level plane, without gravity: w = v / r."""
    rate = speed / radius
    t = clock(2 * np.pi * turns / rate)
    angle = rate * t
    pos = np.stack([radius * np.cos(angle), radius * np.sin(angle), np.ones_like(t)], axis=1)
    vel = speed * np.stack([-np.sin(angle), np.cos(angle), 0 * t], axis=1)
    return motion(t, pos, vel, gravity=0.0, **more)


def orbiting(eccentricity: float = 0.3, period: float = 2.0, turns: float = 1.0, **more: Any) -> Trajectory:
    """A planet on Kepler's ellipse of semi-major axis 1 m about a sun at the origin's height of 1 m, from perihelion.

    Kepler's equation M = E - e sin E, solved by Newton's method. Source: any text on celestial mechanics.
    """
    t = clock(period * turns)
    mean = 2 * np.pi * t / period
    anomaly = mean + eccentricity * np.sin(mean)
    for _ in range(30):
        anomaly = anomaly - (anomaly - eccentricity * np.sin(anomaly) - mean) / (1 - eccentricity * np.cos(anomaly))
    minor = np.sqrt(1 - eccentricity**2)
    rate = 2 * np.pi / period / (1 - eccentricity * np.cos(anomaly))
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    pos[:, 1] = np.stack([np.cos(anomaly) - eccentricity, minor * np.sin(anomaly), 0 * t], axis=1)
    vel[:, 1] = np.stack([-np.sin(anomaly) * rate, minor * np.cos(anomaly) * rate, 0 * t], axis=1)
    pos[:, :, 2] = 1.0
    more.setdefault("mass", [1e3, 1.0])
    return motion(t, pos, vel, names=("sun", "body"), gravity=0.0, **more)


def downhill(
    angle_deg: float = 30.0, friction: float = 0.0, rolls: bool = False, seconds: float = 1.0, **more: Any
) -> Trajectory:
    """A block sliding, or a solid ball rolling, down an incline: a = g (sin - mu cos), or 5/7 g sin."""
    t, slope = clock(seconds), np.radians(angle_deg)
    a = rolling_acceleration(angle_deg, g=G) if rolls else slope_acceleration(angle_deg, friction, G)
    way = np.array([np.cos(slope), 0.0, -np.sin(slope)])
    pos = np.array([0.0, 0.0, 10.0]) + (a * t**2 / 2)[:, None] * way
    spin = np.stack([0 * t, (a * t / 0.05 if rolls else 0 * t), 0 * t], axis=1)[:, None]
    turned = (a * t**2 / 2 / 0.05) if rolls else 0 * t
    quat = np.stack([np.cos(turned / 2), 0 * t, np.sin(turned / 2), 0 * t], axis=1)[:, None]
    touch: list[Touch] = [(-1, 0, np.ones(len(t), dtype=bool), 1e-5, G * np.cos(slope))]
    return motion(t, pos, (a * t)[:, None] * way, quat=quat, angvel=spin, touches=touch, **more)


def drifting(terminal: float = 2.0, seconds: float = 2.0, height: float = 10.0, **more: Any) -> Trajectory:
    """Falling with drag proportional to the speed: v = vt (1 - exp(-g t / vt)). Source: Stokes drag."""
    t = clock(seconds)
    tau = terminal / G
    v = terminal * (1 - np.exp(-t / tau))
    fallen = terminal * (t - tau * (1 - np.exp(-t / tau)))
    pos = np.stack([0 * t, 0 * t, height - fallen], axis=1)
    return motion(t, pos, np.stack([0 * t, 0 * t, -v], axis=1), **more)


def two(first: Trajectory, second: Trajectory, names: tuple[str, str] = ("a", "b")) -> Trajectory:
    """Two independent bodies: the first body of each recording, side by side, 10 m apart."""
    rows = min(len(first.t), len(second.t))
    both = [part.before(rows) for part in (first, second)]
    shift = np.array([[0.0, 0.0, 0.0], [0.0, 10.0, 0.0]])
    touches: list[Touch] = []
    for index, part in enumerate(both):
        mask = part.touching[:, 0] if part.touching is not None else np.zeros(rows, dtype=bool)
        touches.append((-1, index, mask, 1e-5, G))

    def join(channel: str) -> np.ndarray:
        return np.stack([getattr(part, channel)[:, 0] for part in both], axis=1)

    mass = [float(part.mechanics.mass[0]) if part.mechanics.mass is not None else 1.0 for part in both]
    size = [
        2 * float(part.mechanics.half_extents[0, 0]) if part.mechanics.half_extents is not None else 0.1
        for part in both
    ]
    gravity = -float(first.gravity[2])
    return motion(
        first.t[:rows], join("pos") + shift, join("linvel"), names=names, quat=join("quat"), angvel=join("angvel"),
        mass=mass, size_m=size, touches=touches, gravity=gravity,
    )  # fmt: skip


__all__ = ["DT", "circling", "downhill", "drifting", "orbiting", "thrown", "two"]
