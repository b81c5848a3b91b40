"""What a stirred liquid and the bodies in it give each other: tools take the water along, floats are borne."""

from typing import TYPE_CHECKING

import numpy as np

from .body_motion import BodyMotion
from .stirred_vessels import Grid, Vessel
from .swirl_kernel import covered, read
from .tool_samples import Samples

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
DRAG = 1.2
"""Of a tool: the coefficient by which it takes the water along, of its thinnest side; the rest of its drag is the flow around it."""
SLOW = 0.4
"""Of a free body's speed relative to the water, at most so much is lost within a question."""


class Tools:
    """The part of `stirred.Stirred` that knows its bodies; what it needs of the liquid is declared here."""

    grid: Grid
    vessel: Vessel
    density: float
    depth: Array
    bed: Array
    u: Array
    v: Array
    _x: Array
    _y: Array
    _ways: Array
    _gravity: float
    _tools: list[int]
    _samples: Samples
    _motion: BodyMotion
    _masses: Array
    _spread: float

    def _met(self, data: "mujoco.MjData", seconds: float, found: Array) -> tuple[Array, Array, Array]:
        """What of its columns tools take along, 1/s (I, J), how these go (I, J, 2), and whose; adds what floats are borne by."""
        shape = self.depth.shape
        cover, goes, whose = np.zeros(shape), np.zeros((*shape, 2)), np.full(shape, -1)
        if not self._tools:
            return cover, goes, whose
        bodies = self._motion.now(data, seconds)
        self._now = bodies
        places, ways, sizes, owners = self._samples.now(data, bodies)
        low = places - (0.0, 0.0, self.vessel.floor)
        under = (low[:, 2] < float((self.bed + self.depth).max())) & (low[:, 2] > 0)
        covered(
            self._x, self._y, self.depth, self.bed, self._spread, self.grid.round, self.grid.middle, self.grid.deep,
            np.array(self.grid.reach), low[under], ways[under], sizes[under], owners[under], cover, goes, whose,
        )  # fmt: skip
        self._borne(low, ways, sizes, owners, seconds, found)
        fast = np.linalg.norm(goes - self._ways, axis=2)
        cover = cover * (DRAG / 2) * fast / np.append(self._samples.thin, 1.0)[whose]
        for row in range(len(self._tools)):
            if np.isfinite(self._masses[row]):
                mine = whose == row
                brakes = float((cover * self.depth * self.grid.area[:, None])[mine].sum()) * self.density * seconds
                cover[mine] *= min(1.0, SLOW * self._masses[row] / max(brakes, 1e-12))
        return cover, goes, whose

    def _borne(self, places: Array, ways: Array, sizes: Array, owners: Array, seconds: float, found: Array) -> None:
        """Archimedes at the surface as it lies, and what brakes a float up and down."""
        grid, top = self.grid, self.bed + self.depth
        wide = float(grid.wide[0])
        high = np.zeros((3, len(places)))
        step = grid.deep
        for n, off in enumerate(((0.0, 0.0), (step, 0.0), (0.0, step))):
            read(
                places[:, :2] + off,
                top,
                grid.round,
                grid.middle,
                grid.deep,
                grid.turn,
                wide,
                np.array(grid.reach),
                high[n],
            )
        inside = self._inside(places[:, :2])
        below = inside * np.clip((high[0] - places[:, 2]) / self._samples.coarse + 0.5, 0.0, 1.0)
        for row, number in enumerate(self._tools):
            if not np.isfinite(self._masses[row]):
                continue
            mine = owners == row
            weight = self.density * sizes[mine] * below[mine]
            force = np.zeros((mine.sum(), 3))
            force[:, 2] = weight * self._gravity
            for axis in range(2):
                force[:, axis] = -weight * self._gravity * (high[axis + 1] - high[0])[mine] / step
            brake = min(20.0, SLOW * self._masses[row] / max(weight.sum() * seconds, 1e-12))
            force[:, 2] -= brake * weight * ways[mine, 2]
            arm = places[mine] + (0.0, 0.0, self.vessel.floor) - self._now[row, :3]
            found[number, :3] += force.sum(axis=0)
            found[number, 3:] += np.cross(arm, force).sum(axis=0)

    def _inside(self, places: Array) -> Array:
        away = np.abs(places - self.grid.middle)
        if self.grid.round:
            return np.asarray(np.hypot(*away.T) <= self.grid.reach[0])
        return np.asarray((away <= np.array(self.grid.reach)).all(axis=1))

    def _at_sides(self, goes: Array) -> tuple[Array, Array]:
        """Velocities in the middle of cells, m/s along x and y, as those across rows (I + 1, J) and columns (I, J)."""
        grid = self.grid
        if not goes.any():
            return np.zeros_like(self.u), np.zeros_like(self.v)
        some = np.asarray(goes.any(axis=2))
        whole = goes[some].mean(axis=0)
        full = np.where(some[..., None], goes, whole)
        if grid.round:
            j = np.arange(grid.columns)
            across, along = (j + 0.5) * grid.turn, j * grid.turn
            goes_u = full[..., 0] * np.cos(across) + full[..., 1] * np.sin(across)
            mean = (full + np.roll(full, 1, axis=1)) / 2
            goes_v = -mean[..., 0] * np.sin(along) + mean[..., 1] * np.cos(along)
        else:
            goes_u, goes_v = full[..., 0], (full[..., 1] + np.roll(full[..., 1], 1, axis=1)) / 2
        inner = (goes_u[1:] + goes_u[:-1]) / 2
        return np.concatenate([goes_u[:1], inner, goes_u[-1:]]), np.ascontiguousarray(goes_v)

    def _push(self, held: Array, whose: Array, seconds: float, found: Array) -> None:
        """What the tools are given by the water that they took along, at half its depth."""
        grid = self.grid
        if grid.round:
            a = (np.arange(grid.columns) + 0.5) * grid.turn
            x = held[..., 0] * np.cos(a) - held[..., 1] * np.sin(a)
            y = held[..., 0] * np.sin(a) + held[..., 1] * np.cos(a)
        else:
            x, y = held[..., 0], held[..., 1]
        force = -self.density / seconds * np.stack([x, y, np.zeros_like(x)], axis=-1)
        z = self.vessel.floor + self.bed + self.depth / 2
        for row, number in enumerate(self._tools):
            mine = whose == row
            if mine.any():
                arm = np.stack([self._x, self._y, z], axis=-1)[mine] - self._now[row, :3]
                found[number, :3] += force[mine].sum(axis=0)
                found[number, 3:] += np.cross(arm, force[mine]).sum(axis=0)
