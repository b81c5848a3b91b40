"""Flexes of triangles that close around something, as solid things: water, a tube, a balloon.

MuJoCo draws a flex of triangles as a sheet with two sides, a little thicker than nothing, which makes a bubble of what should be
water. One in which each edge has two triangles that go round it in opposite senses is drawn as what it encloses instead, smooth
where it is round at the start, with an edge where two of its faces meet at more than `EDGE`.
"""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from worldkit.in_pieces import pieces

if TYPE_CHECKING:
    import mujoco

EDGE = np.cos(np.radians(40.0))


class ClosedFlex:
    """One such flex: its corners as triangles, three to each, and smooth normals, from where its points are.

    Args:
        model: the world.
        flex: the number of a flex that `closed` says is one.
        points: (n, 3) m, at the start; which edges are sharp is told by them.
    """

    def __init__(self, model: mujoco.MjModel, flex: int, points: np.ndarray) -> None:
        first, count = int(model.flex_vertadr[flex]), int(model.flex_vertnum[flex])
        self._rows = slice(first, first + count)
        self._triangles = _triangles(model, flex)
        normals = _areas(points[self._triangles])
        unit = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
        corner = self._triangles.ravel()
        order = np.argsort(corner, kind="stable")
        ends = np.searchsorted(corner[order], np.arange(count + 1))
        faces, meeting = [], []
        self._sets = 0
        self._meeting = np.zeros(len(corner), np.int64)
        """(3 F,) of each corner, which faces meet smoothly there: most corners of a point share one such set."""
        for one, other in pairwise(ends):
            mine = order[one:other]
            near = unit[mine // 3] @ unit[mine // 3].T > EDGE
            sets = near[:1] if near.all() else near
            i, j = np.nonzero(sets)
            self._meeting[mine] = self._sets + (0 if len(sets) == 1 else np.arange(len(mine)))
            meeting.append(self._sets + i)
            faces.append(mine[j] // 3)
            self._sets += len(sets)
        self._faces, self._of_set = np.concatenate(faces), np.concatenate(meeting)
        beads = _beads(self._triangles, count)
        self._parts = [~beads, beads] if beads.any() else [~beads]
        self.corners = [self._triangles[part].ravel() for part in self._parts]
        """Of each piece that `read` gives (3 F,) which of the flex's points its corners are."""
        low, high = points.min(axis=0), points.max(axis=0)
        self.half, self.middle = float((high - low)[:2].mean() / 2), (low + high) / 2
        """Half the width, m, and the middle (3,), m, at the start: drops that fly do not count."""

    def read(self, data: mujoco.MjData) -> list[tuple[np.ndarray, np.ndarray]]:
        """(3 F, 3) m and (3 F, 3): the corners and their normals in a state, of its largest piece, and of its beads where it has some."""
        points = data.flexvert_xpos[self._rows][self._triangles]
        areas = _areas(points)[self._faces]
        normals = np.stack([np.bincount(self._of_set, areas[:, k], self._sets) for k in range(3)], axis=1)
        normals = normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-30)
        normals = normals[self._meeting].reshape(-1, 3, 3)
        return [(points[part].reshape(-1, 3), normals[part].reshape(-1, 3)) for part in self._parts]


def closed(model: mujoco.MjModel, flex: int) -> bool:
    """Whether a flex is of triangles that close around something."""
    if model.flex_dim[flex] != 2:
        return False
    faces = _triangles(model, flex).astype(np.int64)
    sides = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]])
    most = int(faces.max(initial=0)) + 1
    there, back = sides @ (most, 1), sides @ (1, most)
    return len(np.unique(there)) == len(there) and bool(np.array_equal(np.sort(there), np.sort(back)))


def _triangles(model: mujoco.MjModel, flex: int) -> np.ndarray:
    first = int(model.flex_elemdataadr[flex])
    return np.asarray(model.flex_elem[first : first + 3 * int(model.flex_elemnum[flex])]).reshape(-1, 3)


def _beads(triangles: np.ndarray, count: int) -> np.ndarray:
    """(F,) whether a triangle belongs to another piece than the largest one."""
    part = pieces(np.concatenate([triangles[:, :2], triangles[:, 1:]]), count)
    return np.asarray(part != np.bincount(part).argmax())[triangles[:, 0]]


def _areas(triangles: np.ndarray) -> np.ndarray:
    """(F, 3): the normals of triangles (F, 3, 3), twice as long as their areas."""
    a, b = triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0]
    return np.stack(
        [
            a[:, 1] * b[:, 2] - a[:, 2] * b[:, 1],
            a[:, 2] * b[:, 0] - a[:, 0] * b[:, 2],
            a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0],
        ],
        axis=1,
    )
