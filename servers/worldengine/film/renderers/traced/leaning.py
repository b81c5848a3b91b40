"""Keep the normals that shade a mesh near those of its triangles.

Where a triangle that is seen has a normal which leans away from the eye, beyond a right angle, no light comes from it: dark
specks along the outlines and creases of what is finely curved and coarsely meshed, a sculpted ear or stalk. Once no normal
leans further than so much (`upright`), those that an eye may meet beyond a right angle are few, and turned to it (`facing`).
"""

from __future__ import annotations

import numpy as np

from .rounded import Mesh

MOST_DEG = 20.0
"""A sculpted mesh leans by 3 degrees or less nearly everywhere; a cylinder of nine sides, by 20."""
LEAST = 0.05
"""What is seen faces the eye at least so much, as the cosine between normal and sight."""


def upright(mesh: Mesh) -> Mesh:
    """The mesh, of which no corner's normal leans further than `MOST_DEG` from its triangle's; those that did are split off."""
    corners, normals = mesh.points[mesh.faces], mesh.normals[mesh.faces]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    area = np.linalg.norm(across, axis=1, keepdims=True)
    across = (across / np.maximum(area, 1e-30))[:, None]
    along = np.einsum("fck,fck->fc", normals, np.broadcast_to(across, normals.shape))
    most = np.radians(MOST_DEG)
    # A triangle without area has no side, and of one that is turned inside out it is not known which is meant.
    leans = (along < np.cos(most)) & (along > 0) & (area > 1e-14)
    if not leans.any():
        return mesh
    aside = normals - along[..., None] * across
    aside /= np.maximum(np.linalg.norm(aside, axis=-1, keepdims=True), 1e-12)
    bent = (np.cos(most) * across + np.sin(most) * aside)[leans]
    vertex, faces = mesh.faces[leans], mesh.faces.copy()
    faces[leans] = len(mesh.points) + np.arange(len(vertex))
    uv = None if mesh.uv is None else np.concatenate([mesh.uv, mesh.uv[vertex]])
    return Mesh(np.concatenate([mesh.points, mesh.points[vertex]]), np.concatenate([mesh.normals, bent]), faces, uv)


def facing(points: np.ndarray, normals: np.ndarray, eye: np.ndarray) -> np.ndarray:
    """Normals (V, 3) at points (V, 3), m, of which those of any triangle that an eye (3,) sees face it; the same if all do."""
    sight = eye - points
    sight /= np.maximum(np.linalg.norm(sight, axis=1, keepdims=True), 1e-12)
    along = np.einsum("vk,vk->v", normals, sight)
    away = (along < LEAST) & (along > -1.01 * np.sin(np.radians(MOST_DEG)))
    if not away.any():
        return normals
    turned = normals.copy()
    turned[away] += (LEAST - along[away])[:, None] * sight[away]
    turned[away] /= np.linalg.norm(turned[away], axis=1, keepdims=True)
    return turned
