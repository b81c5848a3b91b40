"""A leaf: thinner than what distance functions can hold, so it is a mesh of its own, bent and pleated."""

from typing import NamedTuple

import numpy as np

from ..errors import ProgramError
from ..forms.lattice import lattice

STALK = 0.14
"""Share of the length that is the stalk."""
THICK = 0.004
"""Thickness as a share of the length."""
ASIDE = 0.22
"""How far towards the tip a side vein runs on its way to the edge, as a share of the length."""


class Leaf(NamedTuple):
    """A closed mesh: `vertices` (V, 3) m, `faces` (F, 3), `uv` (V, 2) from the stalk (0) to the tip (1), and across."""

    vertices: np.ndarray
    faces: np.ndarray
    uv: np.ndarray


def leaf(length: float = 0.08, width: float = 0.045, *, curl_deg: float = 40.0, veins: int = 7) -> Leaf:
    """A thin leaf with its stalk, along x, for `film.mesh`: bent up by `curl_deg` from end to end, `veins` on each side.

    Length, m, is measured along the blade before it is bent. The middle of the box around it is the origin, z its upper side.
    With no veins it is coarse: 216 triangles, for many at once.

    Raises:
        ProgramError: a size that is not above 0, a curl beyond 330 degrees, or more than 20 veins.
    """
    good = np.isfinite([length, width, curl_deg]).all() and 0 < width <= 4 * length and abs(curl_deg) <= 330
    if not good or not 0 <= veins <= 20:
        raise ProgramError(
            f"there is no leaf of {length} by {width} m, bent by {curl_deg} degrees, with {veins} veins",
            "sculpt.leaf",
            "sculpt.leaf(0.08, 0.045, curl_deg=40, veins=7)",
        )
    rows, columns = (6 * veins + 7, 15) if veins else (11, 5)
    along, across = np.meshgrid(np.linspace(0, 1, rows), np.linspace(-1, 1, columns), indexing="ij")
    blade = np.clip((along - STALK) / (1 - STALK), 0.0, 1.0)
    half = 0.5 * width * (blade**0.65 * (1 - blade) ** 0.85) / (0.4333**0.65 * 0.5667**0.85)
    phase = 2 * np.pi * veins * (blade - ASIDE * np.abs(across))
    half = half * (0.97 + 0.03 * np.sin(phase)) if veins else half
    half = np.maximum(half, 0.016 * width * (1 - 0.8 * blade))
    y = half * across
    # The midrib is the lowest line, and the blade rises to its edges in pleats between the veins.
    high = np.abs(across) * half * (0.22 + (0.05 * np.sin(phase) * np.abs(across) if veins else 0.0))
    if veins:
        high = high - 0.012 * length * np.exp(-((y / (0.03 * width)) ** 2)) * (1 - blade)
    turn = np.radians(curl_deg) if abs(curl_deg) > 1e-3 else 1e-5
    bend, radius = turn * (along - 0.5), length / turn
    middle = np.stack([(radius - high) * np.sin(bend), y, radius - (radius - high) * np.cos(bend)], axis=-1)
    up = np.stack([-np.sin(bend), np.zeros_like(bend), np.cos(bend)], axis=-1) * (0.5 * THICK * length)
    k = np.arange(rows * columns).reshape(rows, columns)
    top = lattice(rows, columns)[:, [0, 2, 1]]  # its rows run along x
    rim = np.concatenate([k[:, 0], k[-1, 1:], k[-2::-1, -1], k[0, -2:0:-1]])
    after, below = np.roll(rim, -1), rows * columns
    edge = np.concatenate([np.stack([rim, rim + below, after], 1), np.stack([after, rim + below, after + below], 1)])
    vertices = np.concatenate([(middle + up).reshape(-1, 3), (middle - up).reshape(-1, 3)])
    vertices -= 0.5 * (vertices.min(axis=0) + vertices.max(axis=0))
    uv = np.tile(np.stack([along, 0.5 + 0.5 * across], axis=-1).reshape(-1, 2), (2, 1))
    return Leaf(vertices, np.concatenate([top, top[:, ::-1] + below, edge]), uv)
