"""What a breakable thing breaks into: convex blocks cut along planes, grouped into pieces that share faces.

A piece is one body. Its hull lies within its own cell, so that hulls of neighbours never overlap; they stand `GAP_M` back from a
shared face, so that what is bonded does not collide there, and does once it is loose.
"""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from ..forms import Form
from ..parts import rotation
from ..turning import cross
from .convex_cells import OUTSIDE, Cell, Face, cells
from .section import Section, section

Array = np.ndarray
GAP_M = 5e-5
"""How far a hull stands back from the face that it shares, m."""
INNER = -2
"""The neighbour of a face between two blocks of one piece."""
ALIGNED = 0.97
"""Cosine from which on a face looks along a direction."""
TOO_SMALL = 1e-4
"""Pieces that share less than this share of the largest face are no neighbours."""


class Piece(NamedTuple):
    """One piece in the frame of the whole."""

    cells: tuple[Cell, ...]
    hull: Array
    """(N, 3) m: what collides."""
    volume: float
    """m^3."""
    centre: Array
    """(3,) m."""
    inertia: Array
    """(3, 3) m^2 about its centre, along the axes of the whole: times its mass."""

    def skin(self, inside: bool) -> "tuple[Array, Array] | None":
        """(N, 3) m and (F, 3): its flat faces with sharp edges, the old skin or, `inside`, the faces that it breaks along."""
        faces = [face for cell in self.cells for face in cell.faces]
        return triangles([f for f in faces if f.neighbour != INNER and (f.neighbour >= 0) == inside])


class Fragments(NamedTuple):
    """All pieces of a thing, in the frame of the box around it."""

    pieces: tuple[Piece, ...]
    bonds: tuple[tuple[int, int, Section], ...]
    """Two pieces that share a face, and that face; its normal points from the first to the second."""
    extents: tuple[float, float, float]
    """m."""

    @property
    def volume(self) -> float:
        """m^3."""
        return float(sum(piece.volume for piece in self.pieces))

    def tilted(self, deg_x: float) -> "Fragments":
        """Turned about x by so many degrees, in the frame of the box around it then."""
        if not deg_x:
            return self
        turn = np.array(rotation(deg_x=deg_x))
        groups = [
            [Cell(tuple(f._replace(corners=f.corners @ turn.T) for f in cell.faces)) for cell in piece.cells]
            for piece in self.pieces
        ]
        return joined(groups, [piece.hull @ turn.T for piece in self.pieces])

    def rim(self, normal: Array) -> list[tuple[int, Section]]:
        """Pieces with outer faces that look along `normal` (3,), and the section by which something may hold each there."""
        normal, found = normal / np.linalg.norm(normal), []
        for number, piece in enumerate(self.pieces):
            outer = [f.corners for cell in piece.cells for f in cell.faces if f.neighbour == OUTSIDE]
            mine = [corners for corners in outer if across(corners) @ normal > ALIGNED]
            if mine:
                found.append((number, section(mine, normal)))
        return found


def joined(groups: Sequence[Sequence[Cell]], hulls: Sequence[Array]) -> Fragments:
    """The fragments of cells whose faces name their neighbours: each group is one piece, and collides as its hull.

    The frame is moved to the middle of the box around all of them.
    """
    points = np.concatenate([face.corners for group in groups for cell in group for face in cell.faces])
    middle = (points.min(axis=0) + points.max(axis=0)) / 2
    moved = [
        tuple(Cell(tuple(f._replace(corners=f.corners - middle) for f in cell.faces)) for cell in group)
        for group in groups
    ]
    pieces = [_piece(group, hull - middle) for group, hull in zip(moved, hulls, strict=True)]
    shared: dict[tuple[int, int], list[Array]] = {}
    for number, group in enumerate(moved):
        for face in (face for cell in group for face in cell.faces if face.neighbour > number):
            shared.setdefault((number, face.neighbour), []).append(face.corners)
    least = TOO_SMALL * max(map(_area, (p for polygons in shared.values() for p in polygons)), default=0.0)
    bonds = [
        (one, other, section(polygons, across(polygons[0])))
        for (one, other), polygons in sorted(shared.items())
        if sum(map(_area, polygons)) > least
    ]
    x, y, z = (float(v) for v in np.ptp(points, axis=0))
    return Fragments(tuple(pieces), tuple(bonds), (x, y, z))


def voronoi(blocks: Sequence[Cell], seeds: Array) -> Fragments:
    """Cut convex blocks that fill a thing by the cells of its seeds (n, 3), m; each seed is a piece.

    The blocks touch and do not overlap; a face that two of them share whole is inside.

    Raises:
        ValueError: a seed owns nothing, or two lie in one place.
    """
    groups: list[list[Cell]] = [[] for _ in seeds]
    corners: list[list[Array]] = [[] for _ in seeds]
    for block in _matched(blocks):
        middle = np.concatenate([face.corners for face in block.faces]).mean(axis=0)
        radius = max(float(np.linalg.norm(face.corners - middle, axis=1).max()) for face in block.faces)
        away = np.linalg.norm(seeds - middle, axis=1)
        near = np.flatnonzero(away <= away.min() + 2 * radius)
        for cell, narrow, owner in zip(
            cells(block, seeds[near]), cells(block, seeds[near], 2 * GAP_M), near, strict=True
        ):
            if cell.faces and narrow.faces:
                told = [
                    f._replace(neighbour=int(near[f.neighbour]) if f.neighbour >= 0 else f.neighbour)
                    for f in cell.faces
                ]
                groups[owner].append(Cell(tuple(told)))
                corners[owner] += [face.corners for face in narrow.faces]
    for number, group in enumerate(groups):
        if not group:
            place = np.round(seeds[number], 4).tolist()
            raise ValueError(f"seed {number} at {place} owns nothing: put it into the solid, farther from the others")
    return joined(groups, [np.unique(np.round(np.concatenate(mine), 9), axis=0) for mine in corners])


def across(corners: Array) -> Array:
    """(3,) the normal of a convex polygon, out of its solid."""
    twice = _doubled(corners)
    return twice / max(float(np.sqrt(twice @ twice)), 1e-300)


def triangles(faces: Sequence[Face]) -> "tuple[Array, Array] | None":
    """(N, 3) m and (F, 3) of convex faces, none of which shares a corner with another; None of none."""
    made, first = [], 0
    for face in faces:
        k = len(face.corners)
        made += [(first, first + n, first + n + 1) for n in range(1, k - 1)]
        first += k
    return (np.concatenate([face.corners for face in faces]), np.array(made)) if made else None


def _area(corners: Array) -> float:
    twice = _doubled(corners)
    return float(np.sqrt(twice @ twice)) / 2


def _doubled(corners: Array) -> Array:
    """(3,) twice the area of a convex polygon, along its normal."""
    a = corners[1:] - corners[0]
    return np.asarray(cross(a[:-1], a[1:]).sum(axis=0))


def _piece(group: tuple[Cell, ...], hull: Array) -> Piece:
    """A piece with the mass properties of its cells."""
    points, faces = triangles([face for cell in group for face in cell.faces]) or (hull, np.zeros((0, 3), int))
    whole = Form(points, faces, (), np.zeros(3))  # faces inside count twice, with opposite signs
    return Piece(group, hull, whole.volume, whole.centre_of_mass, whole.inertia)


def _matched(blocks: Sequence[Cell]) -> list[Cell]:
    """The blocks, with the faces that two of them share whole marked as inside."""
    seen: dict[tuple[float, ...], int] = {}

    def key(face: Face) -> tuple[float, ...]:
        return tuple(np.round([*face.corners.mean(axis=0), _area(face.corners) ** 0.5], 7) + 0.0)

    for face in (face for block in blocks for face in block.faces):
        seen[key(face)] = seen.get(key(face), 0) + 1
    return [
        Cell(tuple(f._replace(neighbour=INNER) if seen[key(f)] > 1 else f for f in block.faces)) for block in blocks
    ]
