"""Give sheets two sides: meshes without a thickness, such as flags and leaves, which a path tracer sees from one side only.

A triangle reflects light on the side that its corners go around counter-clockwise; its back is black. A sheet whose triangles
lie there twice, wound both ways, is met at random by the one or the other, and blotchy; one that lies there once is black from
behind. So both sides are there, each a little before the other.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from worldkit.in_pieces import pieces

from .rounded import Mesh

SHARE, LEAST_M, MOST_M = 2e-4, 2e-5, 2e-4
"""How far a side stands off the sheet: a share of the mesh's extent, between these; rays of 32 bits err by less at 50 m."""
WELD = 1e-5
"""Corners that are nearer than this share of the extent are one: a seam is no edge."""
MANY = 250_000
"""Of a mesh of more triangles, such as a whole hill, only what is wound both ways is found: its back is under it."""


class Sides(NamedTuple):
    """A mesh, and for each of its corners (V,) which corner of the mesh it was made of that is."""

    mesh: Mesh
    origin: np.ndarray


def two_sided(mesh: Mesh) -> Sides:
    """The mesh, of which all that is open or wound both ways has a front and a back; the same if all of it is closed."""
    places, faces = welded(mesh), mesh.faces
    both = _wound_both_ways(places)
    open_ones = _open(places, both) if len(faces) <= MANY else np.zeros(len(faces), bool)
    if not both.any() and not open_ones.any():
        return Sides(mesh, np.arange(len(mesh.points)))
    sheet = np.concatenate([faces[both | open_ones], faces[open_ones][:, ::-1]])
    corners = mesh.points[sheet]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    behind = np.einsum("fk,fck->fc", across, mesh.normals[sheet]) < 0
    key, made = np.unique(2 * sheet + behind, return_inverse=True)
    origin, sign = key // 2, np.where(key % 2, -1.0, 1.0)[:, None]
    normals = sign * mesh.normals[origin]
    off = float(np.clip(SHARE * np.ptp(mesh.points, axis=0).max(initial=0.0), LEAST_M, MOST_M))
    rest, kept = np.unique(faces[~(both | open_ones)], return_inverse=True)
    origin = np.concatenate([rest, origin])
    found = Mesh(
        np.concatenate([mesh.points[rest], mesh.points[origin[len(rest) :]] + off * normals]),
        np.concatenate([mesh.normals[rest], normals]),
        np.concatenate([kept.reshape(-1, 3), len(rest) + made.reshape(-1, 3)]),
        None if mesh.uv is None else mesh.uv[origin],
    )
    return Sides(found, origin)


def welded(mesh: Mesh) -> np.ndarray:
    """Its triangles (F, 3) by places: corners that lie at the same one are one."""
    step = max(WELD * float(np.ptp(mesh.points, axis=0).max(initial=0.0)), 1e-12)
    return _numbered(np.round(mesh.points / step))[mesh.faces]


def _numbered(rows: np.ndarray) -> np.ndarray:
    """A number for each row (N,), the same for equal rows; much faster than sorting them as rows."""
    number = np.zeros(len(rows), dtype=np.int64)
    for column in rows.T:
        _, value = np.unique(column, return_inverse=True)
        _, number = np.unique(number * (len(rows) + 1) + value.reshape(-1), return_inverse=True)
    return number.reshape(-1)


def _wound_both_ways(faces: np.ndarray) -> np.ndarray:
    """Which triangles (F,) have another one in the same place that is wound the other way."""
    order = np.sort(faces, axis=1)
    turns = (faces == order[:, :1]).argmax(axis=1)
    forward = np.take_along_axis(faces, ((turns + 1) % 3)[:, None], 1)[:, 0] == order[:, 1]
    place = _numbered(order)
    count = np.stack([np.bincount(place[way], minlength=place.max(initial=0) + 1) for way in (forward, ~forward)])
    return np.asarray((count > 0).all(axis=0)[place])


def _open(faces: np.ndarray, but: np.ndarray) -> np.ndarray:
    """Which triangles (F,) belong to a piece that has an edge of its own; those of `but` (F,) count for nothing."""
    found = np.zeros(len(faces), bool)
    mine = faces[~but]
    # A triangle that has shrunk to a line has no edges, and covers nothing.
    whole = (mine != np.roll(mine, 1, axis=1)).all(axis=1)
    mine = mine[whole]
    if not len(mine):
        return found
    edges = np.sort(np.concatenate([mine[:, [0, 1]], mine[:, [1, 2]], mine[:, [2, 0]]]), axis=1)
    size = int(faces.max()) + 1
    key, count = np.unique(edges[:, 0].astype(np.int64) * size + edges[:, 1], return_counts=True)
    unique = np.stack([key // size, key % size], axis=1)
    piece = pieces(unique, size)
    open_pieces = np.unique(piece[unique[count == 1, 0]])
    found[np.flatnonzero(~but)[whole]] = np.isin(piece[mine[:, 0]], open_pieces)
    return found
