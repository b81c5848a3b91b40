"""The mesh that shows water, found in the world: its surface, whose corners rise and fall, and beads, each a drop when it flies."""

from typing import TYPE_CHECKING

import numpy as np

from worldkit.errors import ProgramError
from worldkit.moved_shapes import at_rest

from .wet_grid import WetGrid

if TYPE_CHECKING:
    import mujoco

FLAT = 1e-5
"""m: corners so close to the highest lie in the surface."""
HIDDEN = 1e-5
"""m: the radius of a bead that is no drop."""
Array = np.ndarray


class ShownWater:
    """A flex that shows water.

    Args:
        model: the world.
        flex: its number.

    Raises:
        ProgramError: it is of no triangles, or has no surface that lies level and has a shore.
    """

    def __init__(self, model: "mujoco.MjModel", flex: int) -> None:
        from scipy.sparse import coo_matrix
        from scipy.sparse.csgraph import connected_components

        count = int(model.flex_vertnum[flex])
        if int(model.flex_dim[flex]) != 2:
            raise ProgramError(
                "what shows the water is no surface of triangles", "interventions", "make it by waters.fill"
            )
        start, faces = int(model.flex_elemdataadr[flex]), int(model.flex_elemnum[flex])
        self._rest = at_rest(model, flex)
        triangles = model.flex_elem[start : start + 3 * faces].reshape(-1, 3)
        pairs = np.concatenate([triangles[:, :2], triangles[:, 1:]])
        graph = coo_matrix((np.ones(len(pairs)), (pairs[:, 0], pairs[:, 1])), shape=(count, count))
        number, part = connected_components(graph, directed=False)
        sizes = np.bincount(part, minlength=number)
        main = int(sizes.argmax())
        self._main = np.flatnonzero(part == main)
        rest = self._rest[self._main]
        self.level = float(rest[:, 2].max())
        self.floor = float(rest[:, 2].min())
        top = np.abs(self._rest[:, 2] - self.level) < FLAT
        flat = triangles[top[triangles].all(axis=1) & (part[triangles[:, 0]] == main)]
        self.outline = self._rest[_rim(flat), :2] if len(flat) else np.zeros((0, 2))
        """(P, 2) m, of the shore."""
        if len(self.outline) < 3:
            raise ProgramError("what shows the water has no level surface", "interventions", "make it by waters.fill")
        others = [np.flatnonzero(part == one) for one in range(number) if one != main]
        self._beads = np.stack(others) if others and len({len(o) for o in others}) == 1 else np.zeros((0, 1), int)
        own = self._rest[self._beads]
        away = own - own.mean(axis=1, keepdims=True)
        self._ball = away / np.maximum(np.linalg.norm(away, axis=2, keepdims=True), 1e-12)
        high = max(self.level - self.floor, 1e-9)
        self._follows = np.clip((rest[:, 2] - self.floor) / high, 0.0, 1.0) ** 2

    @property
    def beads(self) -> int:
        """How many drops it can show."""
        return len(self._beads)

    def over(self, grid: WetGrid) -> None:
        """Read the heights of a grid's cells from now on."""
        self._read = _between_cells(grid, self._rest[self._main, :2])

    def points(self, heights: Array, place: Array, radius: Array, idle: Array) -> Array:
        """(n, 3) m: its corners, with the surface at heights (C,) over the level, drops (B, 3) and (B,), the idle ones at (3,)."""
        out = self._rest.copy()
        out[self._main, 2] += self._follows * (self._read @ heights)
        if len(self._beads):
            flies = radius > 0
            where = np.where(flies[:, None], place, idle)
            out[self._beads] = where[:, None] + np.where(flies, radius, HIDDEN)[:, None, None] * self._ball
        return out


def _rim(triangles: Array) -> Array:
    """The corners of the longest rim of a mesh, one after another."""
    sides = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
    known = {(int(a), int(b)) for a, b in sides}
    follows = {a: b for a, b in known if (b, a) not in known}
    longest: list[int] = []
    while follows:
        start, at = next(iter(follows.items()))
        loop = [start]
        follows.pop(start)
        while at != start and at in follows:
            loop.append(at)
            at = follows.pop(at)
        longest = max(longest, loop, key=len)
    return np.array(longest, int)


def _between_cells(grid: WetGrid, points: Array) -> "object":
    """(n, C): reads smooth heights at points (n, 2) from cells, by cubics through the four cells around it each way (Catmull, Rom)."""
    from scipy.sparse import csr_matrix
    from scipy.spatial import cKDTree

    place = (points - grid.low) / grid.cell - 0.5
    corner = np.floor(place).astype(int)
    f = place - corner
    t = np.stack([np.ones_like(f), f, f * f, f**3], axis=-1)
    spline = 0.5 * np.array([[0, 2, 0, 0], [-1, 0, 1, 0], [2, -5, 4, -1], [-1, 3, -3, 1]])
    weights = t @ spline
    tree = cKDTree(grid.middle)
    rows, columns, values = [], [], []
    for i in range(4):
        for j in range(4):
            cell = corner + np.array([i - 1, j - 1])
            within = ((cell >= 0) & (cell < np.array(grid.shape))).all(axis=1)
            number = np.where(within, grid.number[tuple(np.where(within[:, None], cell, 0).T)], -1)
            dry = number < 0  # the nearest wet cell stands for it
            if dry.any():
                number[dry] = tree.query(grid.low + (cell[dry] + 0.5) * grid.cell)[1]
            rows.append(np.arange(len(points)))
            columns.append(number)
            values.append(weights[:, 0, i] * weights[:, 1, j])
    shape = (len(points), grid.size)
    return csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=shape)
