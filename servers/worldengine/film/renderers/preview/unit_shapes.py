"""Make unit shapes as vertex arrays (n, 9): corner (x, y, z, cap side), normal (3), texture coordinate (2).

An instance of size (a, b, c) and half length h puts a corner at (x a, y b, z c + side h).
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worldkit.forms.lattice import lattice

from . import hard_edges

if TYPE_CHECKING:
    import mujoco

Vertices = tuple[np.ndarray, np.ndarray]


def _pack(
    corner: np.ndarray, normal: np.ndarray, uv: np.ndarray | None = None, side: np.ndarray | float = 0.0
) -> np.ndarray:
    out = np.zeros((len(corner), 9), dtype=np.float32)
    out[:, 0:3], out[:, 3], out[:, 4:7] = corner, side, normal
    if uv is not None:
        out[:, 7:9] = uv
    return out


def _strips(rows: int, columns: int) -> np.ndarray:
    """(m, 3) triangles of a grid of (rows + 1) x (columns + 1) vertices, row-major, counter-clockwise from outside."""
    i, j = np.meshgrid(np.arange(rows), np.arange(columns), indexing="ij")
    a = (i * (columns + 1) + j).ravel()
    b, c, d = a + 1, a + columns + 1, a + columns + 2
    return np.concatenate([np.stack([a, c, b], -1), np.stack([b, c, d], -1)])


def sphere(sectors: int = 48) -> Vertices:
    """A sphere of radius 1."""
    rows = sectors // 2
    theta = np.linspace(0.0, np.pi, rows + 1)[:, None]
    phi = np.linspace(0.0, 2.0 * np.pi, sectors + 1)[None, :]
    points = np.stack([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta) + 0 * phi], -1).reshape(
        -1, 3
    )
    uv = np.stack(np.broadcast_arrays(phi / (2 * np.pi), 1.0 - theta / np.pi), -1).reshape(-1, 2)
    return _pack(points, points, uv), _strips(rows, sectors)


def capsule(sectors: int = 32) -> Vertices:
    """A unit sphere cut at the equator; the halves move apart by the half length along z."""
    half = sectors // 4
    theta = np.concatenate([np.linspace(0.0, np.pi / 2, half + 1), np.linspace(np.pi / 2, np.pi, half + 1)])
    phi = np.linspace(0.0, 2.0 * np.pi, sectors + 1)[None, :]
    points = np.stack(
        [np.sin(theta)[:, None] * np.cos(phi), np.sin(theta)[:, None] * np.sin(phi), np.cos(theta)[:, None] + 0 * phi],
        -1,
    ).reshape(-1, 3)
    side = np.repeat(np.concatenate([np.ones(half + 1), -np.ones(half + 1)]), sectors + 1)
    return _pack(points, points, None, side), _strips(2 * half + 1, sectors)


def cylinder(sectors: int = 64) -> Vertices:
    """A cylinder of radius 1, with z from -1 to 1."""
    phi = np.linspace(0.0, 2.0 * np.pi, sectors + 1)
    ring = np.stack([np.cos(phi), np.sin(phi), np.zeros_like(phi)], -1)
    up = np.array([0.0, 0.0, 1.0])
    wall = _pack(np.concatenate([ring + up, ring - up]), np.concatenate([ring, ring]))
    vertices, triangles = [wall], [_strips(1, sectors)]
    start = len(wall)
    for z in (1.0, -1.0):
        corner = np.concatenate([ring, np.zeros((1, 3))]) + z * up
        vertices.append(_pack(corner, np.broadcast_to(z * up, corner.shape)))
        i = np.arange(sectors)
        fan = np.stack([np.full(sectors, sectors + 1), i, i + 1], -1)
        triangles.append(start + (fan if z > 0 else fan[:, ::-1]))
        start += len(corner)
    return np.concatenate(vertices), np.concatenate(triangles)


def box() -> Vertices:
    """The cube from -1 to 1."""
    vertices, triangles = [], []
    for axis in range(3):
        for sign in (1.0, -1.0):
            u, v = np.eye(3)[(axis + 1) % 3], np.eye(3)[(axis + 2) % 3]
            n = sign * np.eye(3)[axis]
            corner = np.array([n - u - v, n + u - v, n + u + v, n - u + v])
            face = np.array([[0, 1, 2], [0, 2, 3]]) + 4 * len(vertices)
            vertices.append(_pack(corner, np.broadcast_to(n, (4, 3)), np.array([[0, 0], [1, 0], [1, 1], [0, 1]])))
            triangles.append(face if sign > 0 else face[:, ::-1])
    return np.concatenate(vertices), np.concatenate(triangles)


def quad() -> Vertices:
    """The square from -1 to 1 in the plane z = 0, facing up."""
    corner = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], dtype=float)
    return _pack(corner, np.broadcast_to([0, 0, 1.0], (4, 3)), corner[:, :2] * 0.5 + 0.5), np.array(
        [[0, 1, 2], [0, 2, 3]]
    )


def disc(sectors: int = 48) -> Vertices:
    """A disc of radius 1 in rings that double in radius, so that a vast one is still precise near its centre."""
    radii = np.concatenate([[0.0], 2.0 ** np.arange(-13, 1)])
    phi = np.linspace(0.0, 2.0 * np.pi, sectors + 1)[None, :]
    points = np.stack(
        [radii[:, None] * np.cos(phi), radii[:, None] * np.sin(phi), 0.0 * radii[:, None] * phi], -1
    ).reshape(-1, 3)
    return _pack(points, np.broadcast_to([0, 0, 1.0], points.shape)), _strips(len(radii) - 1, sectors)


def mesh(model: mujoco.MjModel, index: int) -> Vertices:
    """Build a mesh of the model, with each distinct combination of vertex, normal and texture coordinate once.

    What brings no normals of its own has hard edges where its faces meet at more than 35 degrees.
    """
    start, count = model.mesh_faceadr[index], model.mesh_facenum[index]
    faces = slice(start, start + count)
    vertex = model.mesh_face[faces].astype(np.int64).ravel()
    if hard_edges.brings_none(model, index):
        corners = hard_edges.corner_normals(model, index).reshape(-1, 3)
        normals_of, normal = np.unique(np.round(corners, 4), axis=0, return_inverse=True)
        normal = normal.reshape(-1)
    else:
        start = int(model.mesh_normaladr[index])
        normals_of = model.mesh_normal[start : start + int(model.mesh_normalnum[index])]
        normal = model.mesh_facenormal[faces].astype(np.int64).ravel()
    first_uv, count_uv = model.mesh_texcoordadr[index], model.mesh_texcoordnum[index]
    uv_index = (
        model.mesh_facetexcoord[faces].astype(np.int64).ravel() if first_uv >= 0 and count_uv else np.zeros_like(vertex)
    )
    key = (vertex * (normal.max(initial=0) + 1) + normal) * (uv_index.max(initial=0) + 1) + uv_index
    _, chosen, inverse = np.unique(key, return_index=True, return_inverse=True)
    corner = model.mesh_vert[model.mesh_vertadr[index] + vertex[chosen]]
    normals = normals_of[normal[chosen]]
    uv = model.mesh_texcoord[first_uv + uv_index[chosen]] if first_uv >= 0 and count_uv else None
    if uv is not None:
        uv = np.column_stack([uv[:, 0], 1.0 - uv[:, 1]])  # a model's v runs down the rows of its textures, ours runs up
    return _pack(corner, normals, uv), inverse.reshape(-1, 3)


def height_field(model: mujoco.MjModel, index: int) -> Vertices:
    """A height field of the model in metres, with walls down to its base."""
    rows, columns = int(model.hfield_nrow[index]), int(model.hfield_ncol[index])
    rx, ry, top, base = model.hfield_size[index]
    start = model.hfield_adr[index]
    z = model.hfield_data[start : start + rows * columns].reshape(rows, columns) * top
    y, x = np.meshgrid(np.linspace(-ry, ry, rows), np.linspace(-rx, rx, columns), indexing="ij")
    slope_y, slope_x = np.gradient(z, 2 * ry / (rows - 1), 2 * rx / (columns - 1))
    normal = np.stack([-slope_x, -slope_y, np.ones_like(z)], -1)
    normal /= np.linalg.norm(normal, axis=-1, keepdims=True)
    points = np.stack([x, y, z], -1)
    uv = np.stack([x / (2 * rx) + 0.5, y / (2 * ry) + 0.5], -1)
    vertices = [_pack(points.reshape(-1, 3), normal.reshape(-1, 3), uv.reshape(-1, 2))]
    triangles = [lattice(rows, columns)]  # cut as the engine collides
    used = rows * columns
    edges = (
        (points[0], (0, -1, 0)),
        (points[-1, ::-1], (0, 1, 0)),
        (points[::-1, 0], (-1, 0, 0)),
        (points[:, -1], (1, 0, 0)),
    )
    for edge, direction in edges:
        low = edge.copy()
        low[:, 2] = -base
        both = np.concatenate([edge, low])
        vertices.append(_pack(both, np.broadcast_to(np.array(direction, dtype=float), both.shape)))
        triangles.append(used + _strips(1, len(edge) - 1))
        used += len(both)
    return np.concatenate(vertices), np.concatenate(triangles)
