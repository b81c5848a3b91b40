"""Recordings with a still: a camera that looks straight down on a pale ground, and what lies or falls there."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...model.recording.stills import Lens, Stills
from ...model.recording.trajectory import Trajectory
from .analytic import clock, motion

Array = np.ndarray
SIZE = (400, 300)
HIGH_M = 2.0
LIT, DARK = 220, 60
"""Grey values, 0 to 255, of the ground and of a full shadow."""
RED = (200, 40, 30)


def from_above(shadow_m: float = 0.5, edge_m: float = 0.0, **more: Any) -> Trajectory:
    """A ball at the origin casts a shadow 0.1 m wide along +x, `shadow_m` long, that fades over the last `edge_m` of it.

    `camera` looks down from 2 m with a lens of 53.13 degrees: 150 pixels to a metre. A red patch of 0.2 m lies at
    (-0.5, 0.5) m.
    """
    t = clock(1.0)
    zero = np.zeros((len(t), 3))
    fovy = float(np.degrees(2 * np.arctan(0.5)))
    lens = Lens(np.array([0.0, 0.0, HIGH_M]), np.eye(3), fovy, SIZE)
    rows, columns = np.mgrid[0 : SIZE[1], 0 : SIZE[0]]
    x, y = (columns + 0.5 - SIZE[0] / 2) / 150, (SIZE[1] / 2 - rows - 0.5) / 150
    full = np.clip((shadow_m + edge_m / 2 - x) / max(edge_m, 1e-9), 0.0, 1.0)
    share = np.where((x >= 0) & (np.abs(y) < 0.05), full, 0.0)
    picture = np.repeat((LIT + (DARK - LIT) * share)[:, :, None], 3, axis=2)
    picture[(np.abs(x + 0.5) < 0.1) & (np.abs(y - 0.5) < 0.1)] = RED
    made = motion(t, zero, zero, **more)
    return replace(made, stills=Stills({"camera": lens}, {"camera": picture.round().astype(np.uint8)}))


def approaching(size: float = 0.2, speed: float = 1.0, **more: Any) -> Trajectory:
    """A box of this size that rises evenly from the ground towards the same camera for a second."""
    t = clock(1.0)
    pos = np.stack([0 * t, 0 * t, speed * t], axis=1)
    vel = np.tile((0.0, 0.0, speed), (len(t), 1))
    return replace(motion(t, pos, vel, size_m=size, **more), stills=from_above().stills)
