"""Turn closed surfaces that are wound inside out: a path tracer draws them black, and glass of them as air.

Whoever lathes a profile from the wrong end has such a mesh, and the preview, which looks at both sides, shows nothing of it.
"""

import numpy as np

from worldkit.in_pieces import pieces

from .rounded import Mesh
from .two_sides import MANY, welded


def outward(mesh: Mesh) -> Mesh:
    """The mesh, whose closed pieces enclose what they should: the same if all do.

    A piece of negative volume within another piece is a hollow, as a bottle has one, and stays.
    """
    if len(mesh.faces) > MANY or not len(mesh.faces):
        return mesh
    faces = welded(mesh)
    piece = pieces(np.concatenate([faces[:, :2], faces[:, 1:]]), int(faces.max()) + 1)[faces[:, 0]]
    corners = (mesh.points - mesh.points.mean(axis=0))[mesh.faces]
    volume = np.einsum("fk,fk->f", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])) / 6
    solid = np.bincount(piece, volume) * _closed(faces, piece)
    turned = np.full(len(solid), solid.sum() < 0)
    if turned.any():
        solid = -solid
    for number in np.flatnonzero(solid < 0):
        if not _within(corners, piece, number, np.flatnonzero(solid > -solid[number])):
            turned[number] ^= True
    turned &= solid != 0
    if not turned.any():
        return mesh
    mine = turned[piece]
    back = np.zeros(len(mesh.points), bool)
    back[mesh.faces[mine]] = True
    normals = np.where(back[:, None], -mesh.normals, mesh.normals)
    return mesh._replace(normals=normals, faces=np.where(mine[:, None], mesh.faces[:, ::-1], mesh.faces))


def _closed(faces: np.ndarray, piece: np.ndarray) -> np.ndarray:
    """Whether every edge of a piece (P,) is gone along as often one way as the other."""
    size = int(faces.max()) + 1
    edges = np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]).astype(np.int64)
    way = np.where(edges[:, 0] < edges[:, 1], 1, -1)
    _, edge = np.unique(edges.min(axis=1) * size + edges.max(axis=1), return_inverse=True)
    left = np.bincount(edge, way * (edges[:, 0] != edges[:, 1])) != 0
    return np.bincount(np.tile(piece, 3), left[edge]) == 0


def _within(corners: np.ndarray, piece: np.ndarray, inner: int, others: np.ndarray) -> bool:
    """Whether the box around a piece lies in that of one of the others."""
    mine = corners[piece == inner].reshape(-1, 3)
    low, high = mine.min(axis=0), mine.max(axis=0)
    boxes = (corners[piece == other].reshape(-1, 3) for other in others)
    return any((box.min(axis=0) <= low).all() and (high <= box.max(axis=0)).all() for box in boxes)
