"""A form: what is drawn, what collides, and what it weighs like."""

from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

Array = np.ndarray
CREASE_DEG = 35.0
"""Faces that meet at more than this are drawn with an edge between them."""


@dataclass(frozen=True)
class Rod:
    """A piece that is round: from `start` to `end` (3,), m, with flat ends or, where `capped`, half balls beyond them."""

    start: Array
    end: Array
    radius: float
    capped: bool


Piece = Array | Rod
"""A convex piece: the corners (N, 3), m, whose hull it is; or a rod."""


@dataclass(frozen=True)
class Form:
    """A solid in the frame of the box around it."""

    vertices: Array
    """(V, 3) m."""
    faces: Array
    """(F, 3) vertices of the triangles of its closed surface, counter-clockwise seen from outside."""
    pieces: tuple[Piece, ...]
    """What collides: together they fill the solid, and not its cavities."""
    shift: Array
    """(3,) where the origin of the numbers it was made of lies in this frame, m."""

    @classmethod
    def centred(cls, vertices: Array, faces: Array, pieces: Iterable[Piece], shift: Array | None = None) -> "Form":
        """The form moved so that the box around it has its centre at the origin.

        Raises:
            ValueError: the surface is not that of a solid: it has no volume, or is inside out.
        """
        away = -(vertices.min(axis=0) + vertices.max(axis=0)) / 2
        before = np.zeros(3) if shift is None else shift
        made = cls(vertices + away, faces, tuple(moved(piece, away) for piece in pieces), before + away)
        if not made.volume > 0:
            raise ValueError("the shape encloses no volume: check the order and the signs of its points")
        return made

    def tilted(self, deg_x: float) -> "Form":
        """Turned about x by so many degrees, and centred on the box around it again."""
        if not deg_x:
            return self
        from ..parts import rotation

        turn = np.array(rotation(deg_x=deg_x))
        pieces = tuple(moved(piece, np.zeros(3), turn) for piece in self.pieces)
        return Form.centred(self.vertices @ turn.T, self.faces, pieces, turn @ self.shift)

    def clouds(self) -> list[Array]:
        """Of each piece the points (N, 3), m, whose hull it is; round ones by a polyhedron inside them."""
        return [piece if isinstance(piece, np.ndarray) else _around(piece) for piece in self.pieces]

    def levels(self) -> list[tuple[float, Array]]:
        """Its level faces that look up, by height: metres from the centre of its box, and their corners (N, 2); top first."""
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        up = np.cross(b - a, c - a)
        level = up[:, 2] > (1 - 1e-9) * np.linalg.norm(up, axis=1)
        heights = np.round(a[level, 2], 9)
        corners = np.stack([a, b, c], axis=1)[level][:, :, :2]
        return [(float(h), corners[heights == h].reshape(-1, 2)) for h in np.unique(heights)[::-1]]

    @property
    def extents(self) -> tuple[float, float, float]:
        """Full extents of the box around it, m."""
        x, y, z = (round(float(v), 9) for v in np.ptp(self.vertices, axis=0))
        return (x, y, z)

    @cached_property
    def _moments(self) -> tuple[float, Array, Array]:
        """Volume, m^3; centre of mass (3,), m; inertia (3, 3) about it per kilogram, m^2.

        Source: D. Eberly, "Polyhedral mass properties"; sums over the tetrahedra from the origin to each triangle.
        """
        a, b, c = (self.vertices[self.faces[:, k]] for k in range(3))
        six = np.einsum("fi,fi->f", a, np.cross(b, c))
        volume = float(six.sum() / 6)
        if volume == 0.0:
            return 0.0, np.zeros(3), np.zeros((3, 3))
        total = a + b + c
        centre = np.einsum("f,fi->i", six, total) / 24 / volume
        second = sum(np.einsum("f,fi,fj->ij", six, p, p) for p in (a, b, c, total)) / 120 / volume
        second = second - np.outer(centre, centre)
        return volume, centre, np.trace(second) * np.eye(3) - second

    @property
    def volume(self) -> float:
        """Of the solid, m^3."""
        return self._moments[0]

    @property
    def centre_of_mass(self) -> Array:
        """(3,) from the centre of its box, m."""
        return self._moments[1]

    @property
    def inertia(self) -> Array:
        """(3, 3) about its centre of mass along its axes, m^2: times its mass."""
        return self._moments[2]

    def drawn(self) -> tuple[Array, Array, Array]:
        """Vertices (3 F, 3), normals (3 F, 3) and faces (F, 3) as they are drawn: smooth but at creases."""
        corners = self.vertices[self.faces]
        crossed = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
        flat = crossed / np.maximum(np.linalg.norm(crossed, axis=1, keepdims=True), 1e-300)
        _, same = np.unique(np.round(self.vertices, 9), axis=0, return_inverse=True)
        at = same.ravel()[self.faces].ravel()
        owner = np.repeat(np.arange(len(self.faces)), 3)
        order = np.argsort(at, kind="stable")
        normals = np.repeat(flat, 3, axis=0)
        least = np.cos(np.radians(CREASE_DEG))
        for group in np.split(order, np.flatnonzero(np.diff(at[order])) + 1):
            meeting = owner[group]
            smooth = (flat[meeting] @ flat[meeting].T >= least) @ crossed[meeting]
            length = np.linalg.norm(smooth, axis=1, keepdims=True)
            normals[group] = np.where(length > 0, smooth / np.maximum(length, 1e-300), flat[meeting])
        return corners.reshape(-1, 3), normals, np.arange(3 * len(self.faces)).reshape(-1, 3)


def _around(rod: Rod) -> Array:
    """Points on a rod: 24 round each flat end, balls of 24 by 12 at capped ones."""
    turn = np.arange(24) * 2 * np.pi / 24
    way = rod.end - rod.start
    length = float(np.linalg.norm(way))
    if rod.capped or length == 0:
        high = (np.arange(13) / 12 - 0.5) * np.pi
        u, v = np.meshgrid(turn, high)
        ball = np.stack([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)], axis=-1).reshape(-1, 3)
        return np.concatenate([end + rod.radius * ball for end in (rod.start, rod.end)])
    along = way / length
    side = np.cross(along, np.eye(3)[np.abs(along).argmin()])
    side /= np.linalg.norm(side)
    ring = np.outer(np.cos(turn), side) + np.outer(np.sin(turn), np.cross(along, side))
    return np.concatenate([end + rod.radius * ring for end in (rod.start, rod.end)])


def moved(piece: Piece, away: Array, turn: Array | None = None) -> Piece:
    """A piece turned about the origin, then moved."""
    matrix = np.eye(3) if turn is None else turn
    if isinstance(piece, Rod):
        return replace(piece, start=matrix @ piece.start + away, end=matrix @ piece.end + away)
    return piece @ matrix.T + away


def positive(what: str, **numbers: float) -> None:
    """Raise a ValueError unless every number is positive and finite."""
    for name, value in numbers.items():
        if not 0 < value < np.inf:
            raise ValueError(f"{what}: {name} must be a positive number of metres, got {value}")
