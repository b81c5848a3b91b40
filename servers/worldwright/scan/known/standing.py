"""Bodies on several feet, with a contact under each, and on what is no body."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...model.recording.records import Contacts
from ...model.recording.trajectory import Trajectory
from .analytic import G, clock, motion, resting


def standing(lean_m: float = 0.0, half_m: float = 0.1, seconds: float = 1.0, **more: Any) -> Trajectory:
    """A body of 1 kg on four feet at the corners of a square, whose centre of mass moves by `lean_m` along x.

    The feet stay where they are, `half_m` from the middle along x and y. Source: statics; each foot carries a quarter.
    """
    t = clock(seconds)
    rows = np.arange(len(t))
    share = t / seconds
    zero = np.zeros_like(t)
    pos = np.stack([lean_m * share, zero, zero + 0.5], axis=1)
    vel = np.stack([zero + lean_m / seconds, zero, zero], axis=1)
    feet = half_m * np.array([(1, 1, 0), (1, -1, 0), (-1, 1, 0), (-1, -1, 0)], dtype=float)
    count = 4 * len(t)
    up = np.tile((0.0, 0.0, 1.0), (count, 1))
    stood = Contacts(
        row=np.repeat(rows, 4),
        body1=np.full(count, -1),
        body2=np.zeros(count, dtype=int),
        depth_m=np.full(count, 1e-5),
        normal_force=np.full(count, G / 4),
        force=up * G / 4,
        normal=up,
        position=np.tile(feet, (len(t), 1)),
    )
    return replace(motion(t, pos, vel, size_m=2 * half_m, **more), contacts=stood)


def on_flex(**more: Any) -> Trajectory:
    """A body of 1 kg that a flex carries over the ground: what touches it is no geom, and no body."""
    made = resting(**more)
    assert made.contacts is not None
    flex, own = (np.full(len(made.contacts.row), geom) for geom in (-1, 0))
    return replace(made, contacts=replace(made.contacts, geom1=flex, geom2=own))
