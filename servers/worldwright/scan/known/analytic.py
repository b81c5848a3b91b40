"""Motions with known answers, from closed formulas: the cases of the checks and the expectations.

All are worlds of loose bodies under standard gravity g (9.80665 m/s^2), sampled every `DT` seconds as if every
simulation step had been recorded, with the velocities of the formula rather than of differences.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ...model.recording.closed_forms import fall_speed
from ...model.recording.mechanics import Mechanics
from ...model.recording.records import Contacts, Interventions
from ...model.recording.trajectory import STANDARD_GRAVITY, Trajectory

Array = np.ndarray
G = STANDARD_GRAVITY
DT = 0.002
Touch = tuple[int, int, Array, float, float]
"""First body, second body, (T,) mask, depth in m, normal force in N."""


def clock(seconds: float, dt: float = DT) -> Array:
    """(T,) instants from 0 to `seconds`."""
    return np.arange(round(seconds / dt) + 1) * dt


def motion(
    t: Array,
    pos: Array,
    linvel: Array,
    *,
    names: Sequence[str] = ("body",),
    quat: Array | None = None,
    angvel: Array | None = None,
    size_m: float | Sequence[float] = 0.1,
    mass: float | Sequence[float] = 1.0,
    touches: Sequence[Touch] = (),
    normal: Sequence[float] = (0.0, 0.0, 1.0),
    free: bool = True,
    gravity: float = G,
    ground_z: float | None = 0.0,
    **channels: Any,
) -> Trajectory:
    """Loose bodies of the given full size (cubes or balls) and mass; `touches` tells which touch, and when."""
    rows, count = len(t), len(names)
    size = np.broadcast_to(np.asarray(size_m, dtype=float), (count,))
    weight = np.broadcast_to(np.asarray(mass, dtype=float), (count,)).copy()
    half = np.repeat(size[:, None] / 2, 3, axis=1)
    facts = Mechanics(
        mass=weight,
        com=np.zeros((count, 3)),
        inertia=np.repeat((weight * size**2 / 10)[:, None], 3, axis=1),  # a solid ball's, 2/5 m r^2
        inertia_quat=np.tile((1.0, 0.0, 0.0, 0.0), (count, 1)),
        center=np.zeros((count, 3)),
        half_extents=half,
        dynamic=np.ones(count, dtype=bool),
        free=np.full(count, free),
        unforced=np.full(count, free),
        mocap=np.zeros(count, dtype=bool),
        visual_only=np.zeros(count, dtype=bool),
        parent=np.full(count, -1),
        ground_z=ground_z,
        gravity=np.array([0.0, 0.0, -gravity]),
    )
    return Trajectory.from_arrays(
        t,
        names,
        np.asarray(pos, dtype=float).reshape(rows, count, 3),
        quat=quat,
        linvel=np.asarray(linvel, dtype=float).reshape(rows, count, 3),
        angvel=angvel,
        contacts=contacts(touches, normal),
        mechanics=facts,
        time_step=float(t[1] - t[0]),
        **channels,
    )


def contacts(touches: Sequence[Touch], normal: Sequence[float] = (0.0, 0.0, 1.0)) -> Contacts:
    """Contact rows from masks, with one normal for all."""
    parts = []
    for one, other, mask, depth, force in touches:
        row = np.flatnonzero(mask)
        size = len(row)
        parts.append((row, np.full(size, one), np.full(size, other), np.full(size, depth), np.full(size, force)))
    columns = [np.concatenate(c) for c in zip(*parts, strict=True)] if parts else [np.zeros(0)] * 5
    order = np.argsort(columns[0], kind="stable")
    row, one, other, depth, force = (column[order] for column in columns)
    normals = np.tile(np.asarray(normal, dtype=float), (len(row), 1))
    return Contacts(
        row=row.astype(int),
        body1=one.astype(int),
        body2=other.astype(int),
        depth_m=depth.astype(float),
        normal_force=force.astype(float),
        force=normals * force[:, None],
        normal=normals,
        position=np.zeros((len(row), 3)),
    )


def resting(seconds: float = 2.0, *, size: float = 0.1, dt: float = DT, **more: Any) -> Trajectory:
    """A body of 1 kg lying on the ground."""
    t = clock(seconds, dt)
    pos = np.tile((0.0, 0.0, size / 2), (len(t), 1))
    always = np.ones(len(t), dtype=bool)
    return motion(t, pos, np.zeros_like(pos), size_m=size, touches=[(-1, 0, always, 1e-5, G)], **more)


def sliding(speed: float = 1.0, deceleration: float = 0.0, seconds: float = 2.0, **more: Any) -> Trajectory:
    """A body sliding along +x on the ground, braked evenly until it stops: x = v t - a t^2 / 2."""
    t = clock(seconds)
    stop = speed / deceleration if deceleration else np.inf
    s = np.minimum(t, stop)
    x, v = speed * s - deceleration * s**2 / 2, np.where(t < stop, speed - deceleration * s, 0.0)
    pos = np.stack([x, 0 * t, 0 * t + 0.05], axis=1)
    vel = np.stack([v, 0 * t, 0 * t], axis=1)
    return motion(t, pos, vel, touches=[(-1, 0, np.ones(len(t), dtype=bool), 1e-5, G)], **more)


def falling(height: float = 5.0, seconds: float = 0.8, **more: Any) -> Trajectory:
    """A body let go: z = h - g t^2 / 2."""
    t = clock(seconds)
    pos = np.stack([0 * t, 0 * t, height - G * t**2 / 2], axis=1)
    vel = np.stack([0 * t, 0 * t, -G * t], axis=1)
    return motion(t, pos, vel, **more)


def bouncing(
    height: float = 1.0, restitution: float = 0.8, seconds: float = 3.0, radius: float = 0.05, **more: Any
) -> Trajectory:
    """A ball dropped from `height` under its lowest point, leaving each impact with `restitution` times its speed.

    Impact k has speed e^k sqrt(2 g h); the contact is one row at each impact, and every row once the hops are over.
    """
    t = clock(seconds)
    z, v, touch = np.zeros_like(t), np.zeros_like(t), np.zeros(len(t), dtype=bool)
    speed = fall_speed(height, G)
    start, rise = -speed / G, speed
    while rise / G > 2 * DT and start < seconds:
        end = start + 2 * rise / G
        inside = (t >= start) & (t < end)
        s = t[inside] - start
        z[inside], v[inside] = rise * s - G * s**2 / 2, rise - G * s
        hit = np.searchsorted(t, end)
        if hit < len(t):
            touch[hit] = True
        start, rise = end, rise * restitution
    touch |= t >= start
    pos = np.stack([0 * t, 0 * t, z + radius], axis=1)
    vel = np.stack([0 * t, 0 * t, v], axis=1)
    more.setdefault("names", ("ball",))
    return motion(t, pos, vel, size_m=2 * radius, touches=[(-1, 0, touch, 1e-4, G)], **more)


def rolling(
    speed: float = 1.0, radius: float = 0.1, slip: float = 0.0, seconds: float = 2.0, **more: Any
) -> Trajectory:
    """A ball rolling along +x with angular speed (1 - slip) v / r about +y."""
    t = clock(seconds)
    rate = (1 - slip) * speed / radius
    pos = np.stack([speed * t, 0 * t, 0 * t + radius], axis=1)
    vel = np.tile((speed, 0.0, 0.0), (len(t), 1))
    spin = np.tile((0.0, rate, 0.0), (len(t), 1))[:, None]
    quat = np.stack([np.cos(rate * t / 2), 0 * t, np.sin(rate * t / 2), 0 * t], axis=1)[:, None]
    more.setdefault("names", ("ball",))
    touch: list[Touch] = [(-1, 0, np.ones(len(t), dtype=bool), 1e-5, G)]
    return motion(t, pos, vel, quat=quat, angvel=spin, size_m=2 * radius, touches=touch, **more)


def collision(
    masses: tuple[float, float] = (1.0, 1.0),
    speeds: tuple[float, float] = (1.0, -1.0),
    restitution: float = 1.0,
    seconds: float = 1.0,
    **more: Any,
) -> Trajectory:
    """Two balls on a line, without gravity, touching at half time; textbook speeds after the impact.

    u1 = (m1 v1 + m2 v2 + m2 e (v2 - v1)) / (m1 + m2), and u2 likewise. Source: any mechanics text, "collisions".
    """
    t = clock(seconds)
    hit = len(t) // 2
    (m1, m2), (v1, v2) = masses, speeds
    common = m1 * v1 + m2 * v2
    after = np.array([common + m2 * restitution * (v2 - v1), common + m1 * restitution * (v1 - v2)]) / (m1 + m2)
    pos, vel = np.zeros((len(t), 2, 3)), np.zeros((len(t), 2, 3))
    s = (t - t[hit])[:, None]
    pos[:, :, 0] = np.where(s < 0, s * np.array(speeds), s * after) + np.array([-0.05, 0.05])
    vel[:, :, 0] = np.where(s < 0, np.array(speeds), after)
    mask = np.zeros(len(t), dtype=bool)
    mask[hit - 1 : hit + 1] = True
    pos[:, :, 2] = 1.0
    touch: list[Touch] = [(0, 1, mask, 1e-4, 100.0)]
    line = (1.0, 0.0, 0.0)
    return motion(t, pos, vel, names=("a", "b"), mass=masses, touches=touch, normal=line, gravity=0.0, **more)


def swinging(
    length: float = 1.0, amplitude_deg: float = 20.0, damping: float = 0.0, seconds: float = 4.0, **more: Any
) -> Trajectory:
    """A small pendulum in the xz plane on a pivot at z = 2 m: theta = A exp(-c t) cos(sqrt(g / l) t)."""
    t = clock(seconds)
    rate, start = np.sqrt(G / length), np.radians(amplitude_deg)
    angle = start * np.exp(-damping * t) * np.cos(rate * t)
    speed = -start * np.exp(-damping * t) * (damping * np.cos(rate * t) + rate * np.sin(rate * t))
    pos = np.stack([length * np.sin(angle), 0 * t, 2.0 - length * np.cos(angle)], axis=1)
    vel = np.stack([length * np.cos(angle) * speed, 0 * t, length * np.sin(angle) * speed], axis=1)
    spin = np.stack([0 * t, -speed, 0 * t], axis=1)[:, None]
    quat = np.stack([np.cos(angle / 2), 0 * t, -np.sin(angle / 2), 0 * t], axis=1)[:, None]
    more.setdefault("names", ("bob",))
    return motion(t, pos, vel, quat=quat, angvel=spin, free=False, **more)


def tilting(final_deg: float = 90.0, seconds: float = 1.0, **more: Any) -> Trajectory:
    """A body turning evenly about +y to its final tilt, on the ground."""
    t = clock(seconds)
    rate = np.radians(final_deg) / seconds
    quat = np.stack([np.cos(rate * t / 2), 0 * t, np.sin(rate * t / 2), 0 * t], axis=1)[:, None]
    pos = np.tile((0.0, 0.0, 0.05), (len(t), 1))
    spin = np.tile((0.0, rate, 0.0), (len(t), 1))[:, None]
    touch: list[Touch] = [(-1, 0, np.ones(len(t), dtype=bool), 1e-5, G)]
    return motion(t, pos, np.zeros_like(pos), quat=quat, angvel=spin, touches=touch, **more)


def pushed(kind: str = "force", target: str = "body", count: int = 10, value: float = 5.0) -> Interventions:
    """A few interventions of one kind on one target, 1 ms apart."""
    return Interventions(
        time=0.1 + 0.001 * np.arange(count),
        kind=[kind] * count,
        target=[target] * count,
        value=np.tile((value, 0.0, 0.0, 0.0, 0.0, 0.0), (count, 1)),
        work_j=np.full(count, 0.01),
    )
