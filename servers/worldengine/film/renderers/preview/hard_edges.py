"""Normals of meshes that bring none: hard where faces meet at more than 35 degrees, smooth elsewhere.

The compiler gives such meshes one normal for each vertex, the mean of its faces; where those lean too far from it, as at
every corner of a box or a prism, the normal is the file's z axis, whatever the faces are: flat sides look like quilts.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from worldkit.turning import matrices

if TYPE_CHECKING:
    import mujoco

HARD = float(np.cos(np.radians(35.0)))
LEANS = 0.8
"""The compiler leaves a face out of the mean of a vertex when the cosine of their angle is smaller."""
SAME, SHARE = 2e-3, 0.98


def brings_none(model: mujoco.MjModel, index: int) -> bool:
    """Whether the normals of a mesh are those that the compiler makes up where a mesh has none."""
    vertices, faces, first = _mesh(model, index)
    count = int(model.mesh_normalnum[index])
    if count != len(vertices) or not np.array_equal(faces, model.mesh_facenormal[first : first + len(faces)]):
        return False
    start = int(model.mesh_normaladr[index])
    given = model.mesh_normal[start : start + count]
    used = np.unique(faces)
    # The compiler makes them in the file's frame, then turns the mesh to its axes of inertia.
    up = matrices(np.asarray(model.mesh_quat[index], dtype=float)[None])[0][2]
    flat, weight = _faces(vertices, faces)
    mean = _sum(faces, flat * weight, len(vertices))
    near = np.einsum("fkj,fj->fk", _unit(mean, up)[faces], flat) >= LEANS
    kept = np.zeros_like(mean)
    for k in range(3):
        np.add.at(kept, faces[:, k], flat * weight * near[:, k : k + 1])
    for made in (_unit(kept, up), _unit(mean, up)):
        if (np.abs(made - given)[used].max(axis=1) < SAME).mean() >= SHARE:
            return True
    return False


def corner_normals(model: mujoco.MjModel, index: int) -> np.ndarray:
    """(F, 3, 3) a normal for each corner of each face: the mean of those faces at its vertex that lean less than 35 degrees."""
    vertices, faces, _ = _mesh(model, index)
    flat, weight = _faces(vertices, faces)
    owner = np.repeat(np.arange(len(faces)), 3)
    order = np.argsort(faces.ravel(), kind="stable")
    at, face = faces.ravel()[order], owner[order]
    start = np.searchsorted(at, np.arange(len(vertices) + 1))
    found = np.zeros((len(faces), 3, 3))
    begin, end = start[faces], start[faces + 1]
    for turn in range(int((end - begin).max(initial=0))):
        other = face[np.minimum(begin + turn, len(face) - 1)]
        near = (begin + turn < end) & (np.einsum("fkj,fj->fk", flat[other], flat) >= HARD)
        found += flat[other] * weight[other] * near[..., None]
    length = np.linalg.norm(found, axis=-1, keepdims=True)
    return np.where(length > 0, found / np.maximum(length, 1e-30), flat[:, None])


def _mesh(model: mujoco.MjModel, index: int) -> tuple[np.ndarray, np.ndarray, int]:
    point, first = int(model.mesh_vertadr[index]), int(model.mesh_faceadr[index])
    vertices = model.mesh_vert[point : point + int(model.mesh_vertnum[index])].astype(float)
    return vertices, model.mesh_face[first : first + int(model.mesh_facenum[index])].astype(np.int64), first


def _faces(vertices: np.ndarray, faces: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(F, 3) unit normals and (F, 1) twice the areas."""
    corners = vertices[faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1, keepdims=True)
    return across / np.maximum(area, 1e-30), area


def _sum(faces: np.ndarray, values: np.ndarray, count: int) -> np.ndarray:
    total = np.zeros((count, 3))
    for k in range(3):
        np.add.at(total, faces[:, k], values)
    return total


def _unit(vectors: np.ndarray, otherwise: np.ndarray) -> np.ndarray:
    length = np.linalg.norm(vectors, axis=1, keepdims=True)
    return np.where(length > 1e-9, vectors / np.maximum(length, 1e-30), otherwise)
