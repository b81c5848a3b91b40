"""Soft bodies: blocks that swell and are squeezed, as a lattice of bodies under a surface; a skin that a law moves."""

from dataclasses import replace
from typing import Any

import numpy as np

from ...model.recording.shown_points import Lay, ShownPoints
from ...model.recording.trajectory import Trajectory
from .analytic import clock, motion

CUBE = [
    (0, 1, 3), (0, 3, 2), (4, 7, 5), (4, 6, 7), (0, 5, 1), (0, 4, 5), (2, 3, 7), (2, 7, 6), (0, 2, 6), (0, 6, 4),
    (1, 5, 7), (1, 7, 3),
]  # fmt: skip
"""Triangles of a cube's surface, outwards; corner k lies at the bits of k: x, y, z."""


def block(grows: float = 1.0, squeezed: float = 0.0, side: float = 0.2, **more: Any) -> Trajectory:
    """A cube `jelly` whose corners are bodies: it grows `grows` times along every axis and is squeezed along z.

    Squeezed by the share s it is (1 - s) as high and wider so that it keeps its volume, side^3 grows^3. Source: geometry.
    """
    t = clock(1.0)
    corners = np.array(list(np.ndindex(2, 2, 2)), dtype=float) - 0.5
    size = 1 + (grows - 1) * t[:, None]
    low = 1 - squeezed * t[:, None]
    stretch = side * size * np.concatenate([low**-0.5, low**-0.5, low], axis=1)
    pos = corners * stretch[:, None] + np.array([0.0, 0.0, 1.0])
    names = tuple(f"jelly_{x}_{y}_{z}" for x, y, z in np.ndindex(2, 2, 2))
    made = motion(t, pos, np.gradient(pos, t, axis=0), names=names, size_m=0.01, free=False, **more)
    lattice = {"cells": [1, 1, 1], "nodes": list(names), "at": [list(map(float, c)) for c in np.ndindex(2, 2, 2)]}
    flex = {"name": "jelly", "bodies": list(names), "shell": [v for face in CUBE for v in face], "lattice": lattice}
    return replace(made, meta={**made.meta, "flexes": [flex]})


def caving(keeps: float = 0.5, side: float = 0.2, open_at: int = 0) -> Trajectory:
    """A skin `walls` around a cube, moved by a law, beside a body at rest: within 1 s it gets `keeps` times as high; `open_at` faces lack."""
    t = clock(1.0, 0.05)
    corners = (np.array(list(np.ndindex(2, 2, 2)), dtype=float) - 0.5) * side
    high = 1 + (keeps - 1) * t / t[-1]
    lay = Lay(t, (corners * np.stack([high**0, high**0, high], axis=1)[:, None]).reshape(-1, 3))
    pos = np.zeros((len(t), 3))
    flex = {"name": "walls", "bodies": [], "faces": [v for face in CUBE[open_at:] for v in face]}
    return motion(t, pos, pos, meta={"flexes": [flex]}, media=ShownPoints({"walls": lay}))
