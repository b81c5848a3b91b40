"""Texture coordinates for things that bring none: paint lies along the sides of a thing, or around its centre."""

from __future__ import annotations

import numpy as np

from .rounded import Mesh

ORDERS = {3: (1, 2, 0), 4: (2, 0, 1)}
"""By paint mode: the axes in the order that lays the longest side along the grain."""
SHIFT = np.array([0.31, 0.57, 0.83])


def along_sides(mesh: Mesh, mode: int, per_metre: float, seed: float) -> Mesh:
    """Project each face along the axis that it faces most, as the preview renderer does; corners are split as needed.

    Args:
        mesh: in its own frame, m.
        mode: 2, 3 or 4, the longest side: x, y or z.
        per_metre: repeats of the paint.
        seed: shifts the paint, so that no two things are alike.
    """
    order = list(ORDERS.get(mode, (0, 1, 2)))
    facing = np.abs(mesh.normals[mesh.faces].sum(axis=1)[:, order])
    axis = facing.argmax(axis=1)
    key = mesh.faces * 3 + axis[:, None]
    _, chosen, inverse = np.unique(key.ravel(), return_index=True, return_inverse=True)
    vertex, major = mesh.faces.ravel()[chosen], np.repeat(axis, 3)[chosen]
    q = mesh.points[vertex][:, order] * per_metre + seed * SHIFT
    across = np.array([1, 0, 0])[major]
    up = np.array([2, 2, 1])[major]
    rows = np.arange(len(q))
    uv = np.stack([q[rows, across], -q[rows, up]], -1)
    return Mesh(mesh.points[vertex], mesh.normals[vertex], inverse.reshape(-1, 3), uv)


def around_centre(mesh: Mesh) -> Mesh:
    """Longitude and colatitude of each corner as seen from the thing's own origin; faces across the seam are split off it."""
    away = mesh.points / np.maximum(np.linalg.norm(mesh.points, axis=1, keepdims=True), 1e-12)
    turn = np.arctan2(away[:, 1], away[:, 0]) / (2 * np.pi) % 1.0
    down = np.arccos(np.clip(away[:, 2], -1.0, 1.0)) / np.pi
    corner = turn[mesh.faces]
    over = (corner < 0.5) & (np.ptp(corner, axis=1, keepdims=True) > 0.5)
    key = mesh.faces * 2 + over
    _, chosen, inverse = np.unique(key.ravel(), return_index=True, return_inverse=True)
    vertex = mesh.faces.ravel()[chosen]
    uv = np.stack([turn[vertex] + over.ravel()[chosen], down[vertex]], -1)
    return Mesh(mesh.points[vertex], mesh.normals[vertex], inverse.reshape(-1, 3), uv)
