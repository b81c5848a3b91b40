"""Edges of boxes and cylinders where hands and knocks wore off what is painted: a strip of its own along each, in flakes.

The flakes lie on the strip as paint does, so no two things share them; the preview draws the same kind, `shaders/worn.glsl`.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from worldkit.materials.look import Look

from ..preview.finish import linear
from ..preview.surroundings import noise_field
from .rounded import Mesh, edge

STRIP = 0.6
"""The strip is as wide as this share of how far wear reaches, since little is gone beyond."""
MOST = 0.12
"""Wear reaches at most over this share of the smallest half size."""
ROUND = 1.25
"""All of a rounded edge wears, and so much of its radius beyond."""
LEAST, SOFT, SHARE = 0.53, 0.03, 0.85
"""Of the noise, flakes begin here; so soft are they; so much of what is beneath shows."""
PER_M, LARGE_PER_M = 6.0, 1.9
"""Repeats of the noise, 1/m, by which flakes are formed, and by which they are many or few."""


class Parts(NamedTuple):
    """A mesh in two: its sides, and the strips along its edges."""

    sides: Mesh
    strips: Mesh


def width(look: Look, kind: str, half: np.ndarray) -> float:
    """How wide the strips of a thing of half sizes (3,) are, m; 0 where nothing wears."""
    if look.worn_m <= 0 or look.paint is None or look.around or look.clear > 0 or kind not in ("box", "cylinder"):
        return 0.0
    smallest = float(np.min(half))
    return max(STRIP * min(look.worn_m, MOST * smallest), ROUND * edge(smallest))


def parted(mesh: Mesh, kind: str, half: np.ndarray, wide: float) -> Parts:
    """A box or cylinder of half sizes (3,), m, that has a line of corners `wide` from each edge, in two.

    Args:
        mesh: with its texture coordinates.
        kind: "box" or "cylinder".
        half: sizes, m; those of a cylinder are its radius twice, and half its height.
        wide: the strips' width, m.
    """
    middle = mesh.points[mesh.faces].mean(axis=1)
    if kind == "box":
        away = np.sort(half - np.abs(middle), axis=1)[:, 1]
    else:
        away = np.maximum(half[0] - np.linalg.norm(middle[:, :2], axis=1), half[2] - np.abs(middle[:, 2]))
    near = away < wide
    return Parts(_only(mesh, ~near), _only(mesh, near))


def _only(mesh: Mesh, chosen: np.ndarray) -> Mesh:
    """Some of its triangles (F,), with the corners that they need."""
    used, faces = np.unique(mesh.faces[chosen], return_inverse=True)
    uv = None if mesh.uv is None else mesh.uv[used]
    return Mesh(mesh.points[used], mesh.normals[used], faces.reshape(-1, 3), uv)


def flaked(pixels: np.ndarray, look: Look) -> np.ndarray:
    """Scene-linear paint (N, N, 3) of a look, worn as in a strip."""
    size = len(pixels)
    flakes = 0.6 * _repeated(size, look.tile_m * PER_M) + 0.4 * _repeated(size, look.tile_m * LARGE_PER_M)
    t = np.clip((flakes - (LEAST - SOFT)) / (2 * SOFT), 0.0, 1.0)[..., None]
    gone = SHARE * (t * t * (3.0 - 2.0 * t))
    beneath = 1.22 * pixels + 0.025 if look.beneath is None else linear(look.beneath)
    return np.asarray(pixels + gone * (beneath - pixels), dtype=np.float32)


def _repeated(size: int, times: float) -> np.ndarray:
    """The noise (N, N), repeated so often, or the next whole number of times."""
    field = noise_field() / np.float32(255.0)
    at = ((np.arange(size) + 0.5) / size * max(round(times), 1) * len(field)).astype(int) % len(field)
    return np.asarray(field[np.ix_(at, at)])
