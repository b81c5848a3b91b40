"""How high something lies at given places: what grass, trees and drawn turf of a film stand on."""

from collections.abc import Callable

import numpy as np

Height = Callable[[np.ndarray, np.ndarray], np.ndarray]
"""From x and y (arrays of one shape, m, world frame) to heights z of that shape, m; NaN where there is no ground."""


def over(vertices: np.ndarray, faces: np.ndarray) -> Height:
    """The upper side of some triangles, `vertices` (V, 3) in metres and `faces` (F, 3), as a height over x and y."""
    corners = np.asarray(vertices, dtype=float)[np.asarray(faces, dtype=int)]
    edge1, edge2 = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    area = edge1[:, 0] * edge2[:, 1] - edge1[:, 1] * edge2[:, 0]
    level = np.abs(area) > 1e-12
    corners, edge1, edge2, area = corners[level], edge1[level], edge2[level], area[level]
    low, high = corners[:, :, :2].min(axis=1), corners[:, :, :2].max(axis=1)
    origin, far = low.min(axis=0), high.max(axis=0)
    # Cells about as large as the triangles: each point is held against the few of its cell.
    cells = np.clip(((far - origin) / np.maximum(np.median(high - low, axis=0), 1e-6)).astype(int) + 1, 1, 1500)
    step = np.maximum((far - origin) / cells, 1e-9)
    first = np.clip(((low - origin) / step).astype(int), 0, cells - 1)
    last = np.clip(((high - origin) / step).astype(int), 0, cells - 1)
    spans = (last - first + 1).prod(axis=1)
    which = np.repeat(np.arange(len(corners)), spans)
    within = np.arange(len(which)) - np.repeat(np.cumsum(spans) - spans, spans)
    wide = (last - first + 1)[which, 0]
    cell = (first[which, 1] + within // wide) * cells[0] + first[which, 0] + within % wide
    order = np.argsort(cell, kind="stable")
    which, start = which[order], np.searchsorted(cell[order], np.arange(cells.prod() + 1))

    def height(x: np.ndarray, y: np.ndarray) -> np.ndarray:
        x, y = np.broadcast_arrays(np.asarray(x, dtype=float), np.asarray(y, dtype=float))
        points = np.stack([x.ravel(), y.ravel()], axis=-1)
        found = np.full(len(points), -np.inf)
        at = np.floor((points - origin) / step).astype(int)
        inside = np.flatnonzero(((points >= origin - 1e-9) & (points <= far + 1e-9)).all(axis=1))
        at = np.clip(at[inside], 0, cells - 1)
        begin, end = start[at[:, 1] * cells[0] + at[:, 0]], start[at[:, 1] * cells[0] + at[:, 0] + 1]
        for turn in range(int((end - begin).max(initial=0))):
            mine = np.flatnonzero(begin + turn < end)
            triangle = which[begin[mine] + turn]
            point = points[inside[mine]] - corners[triangle, 0, :2]
            u = (point[:, 0] * edge2[triangle, 1] - point[:, 1] * edge2[triangle, 0]) / area[triangle]
            v = (point[:, 1] * edge1[triangle, 0] - point[:, 0] * edge1[triangle, 1]) / area[triangle]
            z = corners[triangle, 0, 2] + u * edge1[triangle, 2] + v * edge2[triangle, 2]
            hit = (u >= -1e-6) & (v >= -1e-6) & (u + v <= 1 + 1e-6)
            found[inside[mine[hit]]] = np.maximum(found[inside[mine[hit]]], z[hit])
        return np.where(np.isfinite(found), found, np.nan).reshape(x.shape)

    return height
