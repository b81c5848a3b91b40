"""What a limb looks like: a tapered tube, and leaves as folded blades that light comes through, in the world's frame, m."""

from typing import TYPE_CHECKING

import numpy as np

from .plant_numbers import SLENDER

if TYPE_CHECKING:
    from .branching import Limb, Point

Mesh = tuple[np.ndarray, np.ndarray, np.ndarray]
"""Vertices (V, 3), normals (V, 3), faces (F, 3)."""
SIDES = 10
ALONG = np.array([0.0, 0.1, 0.32, 0.62, 1.0])
WIDE = np.array([0.03, 0.12, 1.0, 0.78, 0.0]) * 0.5
"""Half the width of a leaf along its way, the stalk first, as shares of length and width."""
FOLD, CURL = 0.22, 0.16
"""How high its edges stand over the midrib, of half its width, and how far its tip hangs, of its length."""


def wood(limb: "Limb") -> Mesh:
    """A tube a little longer than the limb, so that no gap opens where two meet, closed by its own roundness at the ends."""
    foot, tip = np.array(limb.foot), np.array(limb.tip)
    ahead = (tip - foot) / limb.long_m
    side = np.cross(ahead, [0.0, 0.0, 1.0] if abs(ahead[2]) < 0.9 else [1.0, 0.0, 0.0])
    side /= np.linalg.norm(side)
    other = np.cross(ahead, side)
    turn = 2 * np.pi * np.arange(SIDES) / SIDES
    around = np.cos(turn)[:, None] * side + np.sin(turn)[:, None] * other
    r0, r1 = limb.thick[0] / 2, limb.thick[1] / 2
    rings = [
        (-0.9 * r0, 0.4 * r0),
        (-0.4 * r0, 0.9 * r0),
        (0.0, r0),
        (limb.long_m, r1),
        (limb.long_m + 0.5 * r1, 0.8 * r1),
    ]
    rings += [(limb.long_m + 0.95 * r1, 0.05 * r1)]
    points = np.concatenate([foot + at * ahead + radius * around for at, radius in rings])
    normals = np.tile(around, (len(rings), 1))
    k = np.arange(len(rings) * SIDES).reshape(len(rings), SIDES)
    a, b = k[:-1].ravel(), np.roll(k, -1, axis=1)[:-1].ravel()
    return points, normals, np.concatenate([np.stack([a, b, b + SIDES], 1), np.stack([a, b + SIDES, a + SIDES], 1)])


def leaves(told: "tuple[tuple[Point, Point, Point], ...]") -> Mesh:
    """Blades with a fold along the midrib, twelve triangles each."""
    feet, tips, ups = (np.array([one[k] for one in told], dtype=float) for k in range(3))
    long = np.linalg.norm(tips - feet, axis=1)[:, None]
    ahead = (tips - feet) / long
    across = np.cross(ups, ahead)
    across /= np.maximum(np.linalg.norm(across, axis=1), 1e-9)[:, None]
    up = np.cross(ahead, across)
    rows = []
    for part in (-1.0, 0.0, 1.0):
        half = SLENDER * WIDE * abs(part)
        high = FOLD * half - CURL * ALONG**2 + 0.3 * CURL * ALONG
        rows.append(
            feet[:, None]
            + long[:, None]
            * (ALONG[:, None] * ahead[:, None] + part * half[:, None] * across[:, None] + high[:, None] * up[:, None])
        )
    points = np.stack(rows, axis=2)  # leaf, along, across
    n = len(ALONG)
    k = np.arange(3 * n).reshape(n, 3)
    a, b, c, d = k[:-1, :-1].ravel(), k[:-1, 1:].ravel(), k[1:, 1:].ravel(), k[1:, :-1].ravel()
    faces = np.concatenate([np.stack([a, d, b], 1), np.stack([b, d, c], 1)])
    lean = np.array([-0.35, 0.0, 0.35])[None, None, :, None]
    normals = up[:, None, None] + 0 * points - lean * across[:, None, None]
    normals /= np.linalg.norm(normals, axis=-1, keepdims=True)
    every = (np.arange(len(told))[:, None, None] * 3 * n + faces).reshape(-1, 3)
    return points.reshape(-1, 3), normals.reshape(-1, 3), every
