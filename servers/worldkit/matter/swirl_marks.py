"""What is drawn of a stirred liquid: the body of it, closed, with its surface as it lies, and marks that it carries, each with the way that
it came drawn behind it: foam on top, motes within. A motion that shapes nothing (clear water turning) is seen by them alone.
"""

import itertools
from dataclasses import dataclass

import numpy as np

from ..moved_shapes import tube
from .stirred_vessels import Grid, Vessel

Array = np.ndarray
RINGS, AROUND = 34, 84
"""Corners of the surface of a round liquid; a square one has as many in all."""
DOWN = 10
"""Rings of corners down the walls."""
INTO_M = 2e-4
"""So far it reaches into the walls: no gap is seen, and in glass light passes from one to the other."""
LONG = 8
"""Places along a mark, newest first."""
OVER = 1e-4
"""m: by which foam stands out of the surface."""


@dataclass(frozen=True)
class Body:
    """Corners of the drawn body: those of the surface (R C), on a grid of their own, then the surface's middle, walls and floor."""

    vessel: Vessel
    grid: Grid
    """Whose cells' middles are the surface's corners."""
    places: Array
    """(R C, 2) m."""
    border: Array
    """(B,) corners of the surface along the wall, in their order around it."""
    triangles: Array

    def corners(self, surface: Array, floor: Array) -> Array:
        """(n, 3) m, with the surface (R C,) and the floor below its border (B,) at these heights, world frame."""
        top = np.column_stack([self.places, surface])
        middle = self.grid.middle
        edge = surface[self.border]
        rings = []
        for share in np.arange(DOWN) / (DOWN - 1):
            z = np.maximum(edge, floor + 1e-4) * (1 - share) + floor * share
            rings.append(np.column_stack([self._wall(z), z]))
        inner = np.append(top[: self._around, 2].mean(), self.vessel.floor)
        ends = [np.append(middle, inner[0]), np.append(middle, inner[1] - INTO_M)]
        return np.concatenate([top, *rings, ends])

    @property
    def _around(self) -> int:
        return self.grid.columns if self.grid.round else 1

    def _wall(self, z: Array) -> Array:
        """(B, 2) m, where the wall is at heights (B,), a little into it."""
        middle = self.grid.middle
        away = self.places[self.border] - middle
        if self.grid.round:
            far = self.vessel.radius(z) + INTO_M
            return middle + away * (far / np.linalg.norm(away, axis=1))[:, None]
        half = np.array(self.grid.reach)
        out = np.where(np.abs(away) > half - 0.75 * np.array([self.grid.deep, self.grid.wide[0]]), np.sign(away), 0.0)
        return middle + np.where(out != 0, out * (half + INTO_M), away)


def body(vessel: Vessel, grid: Grid) -> Body:
    """The drawn body on a grid of corners."""
    rows, columns = grid.rows, grid.columns
    x, y = grid.middles()
    places = np.column_stack([x.ravel(), y.ravel()])
    number = np.arange(rows * columns).reshape(rows, columns)
    if grid.round:
        border = number[-1]
        right = np.roll(number, -1, axis=1)
        one, two, three, four = number[:-1], number[1:], right[1:], right[:-1]
    else:
        border = np.concatenate([number[:-1, 0], number[-1, :-1], number[:0:-1, -1], number[0, :0:-1]])
        one, two, three, four = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    faces = [np.stack([one, two, three], -1).reshape(-1, 3), np.stack([one, three, four], -1).reshape(-1, 3)]
    many = len(border)
    rings = [border, *(rows * columns + many * n + np.arange(many) for n in range(DOWN))]
    for upper, lower in itertools.pairwise(rings):
        next_upper, next_lower = np.roll(upper, -1), np.roll(lower, -1)
        faces += [np.stack([upper, lower, next_lower], -1), np.stack([upper, next_lower, next_upper], -1)]
    top, bottom = rows * columns + many * DOWN, rows * columns + many * DOWN + 1
    last = rings[-1]
    faces.append(np.stack([last, np.full(many, bottom), np.roll(last, -1)], -1))
    if grid.round:
        inner = number[0]
        faces.append(np.stack([np.full(len(inner), top), inner, np.roll(inner, -1)], -1))
    return Body(vessel, grid, places, border, np.concatenate(faces))


class Marks:
    """Marks that are carried along: the places of each over the last moments, drawn as a thread that thins towards its end.

    Args:
        places: (m, 2) m, at the start.
        depths: (m,) share of the depth at which each is, 1 on the surface.
        width: m.
        trail: s, how long a mark's way behind it is drawn.
    """

    def __init__(self, places: Array, depths: Array, width: float, trail: float) -> None:
        self.places, self.depths, self.width, self._trail = places.copy(), depths, width, trail
        self.way = np.repeat(places[None], LONG, axis=0)
        """(LONG, m, 2) m: where they were; the first is where they are."""
        self._since = 0.0
        one = np.array(tube(LONG, 3))
        self.triangles = (one[None] + 3 * LONG * np.arange(len(places))[:, None, None]).reshape(-1, 3)

    def moved(self, seconds: float) -> None:
        """Take over `places` after so many seconds."""
        each = self._trail / (LONG - 1)
        self._since += seconds
        while self._since >= each:
            self.way[1:] = self.way[:-1].copy()
            self._since -= each
        self.way[0] = self.places

    def put(self, chosen: Array, places: Array) -> None:
        """Put some marks (m,) elsewhere, (k, 2) m: they begin anew."""
        self.places[chosen] = places
        self.way[:, chosen] = places

    def corners(self, height: Array) -> Array:
        """(3 LONG m, 3) m, with the heights (LONG, m) of their places."""
        line = np.concatenate([self.way, height[..., None]], axis=2)
        # One that stands is a dot as long as it is wide.
        step = np.linspace(0.0, -self.width, LONG)[:, None] * np.array([1.0, 0.0, 0.0])
        gone = np.linalg.norm(np.diff(line, axis=0), axis=2).sum(axis=0)
        line = line + step[:, None] * np.clip(1 - gone / self.width, 0.0, 1.0)[None, :, None]
        along = np.gradient(line, axis=0)
        along /= np.maximum(np.linalg.norm(along, axis=2, keepdims=True), 1e-12)
        side = np.cross(along, (0.0, 0.0, 1.0))
        side /= np.maximum(np.linalg.norm(side, axis=2, keepdims=True), 1e-9)
        up = np.cross(side, along)
        thick = 0.5 * self.width * (1.0 - 0.8 * np.linspace(0, 1, LONG) ** 1.5)[:, None, None]
        thick = np.where(np.arange(LONG)[:, None, None] == 0, 0.6 * thick, thick)
        on_top = (self.depths >= 1.0)[None, :, None]
        low = np.where(on_top, 0.35, 0.9)
        lift = np.where(on_top, OVER, 0.0) * np.array([0.0, 0.0, 1.0])
        ring = np.stack([line + thick * side + lift, line - thick * side + lift, line - low * thick * up], axis=2)
        return ring.transpose(1, 0, 2, 3).reshape(-1, 3)
