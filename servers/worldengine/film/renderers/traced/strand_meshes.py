"""Things whose shape comes from MuJoCo's own scene, as meshes of their own for each frame: tendons, flexes and skins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from worldkit.materials.look import NOTHING

from ..preview.finish import linear, of_material, plain
from ..preview.soft_shapes import Patch, SoftShapes, Strand
from . import rounded
from .absorbed import lets_through
from .coatings import Coatings
from .figures import fill, mesh_of

if TYPE_CHECKING:
    import mujoco

NOWHERE = -1e4
"""Height at which spare parts of a tendon lie, m; its number of parts changes as it wraps."""
SPARE = 8


class Strands:
    """The tendons, flexes and skins of one model; their meshes have a fixed number of corners."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData, coatings: Coatings) -> None:
        self.model, self._coatings = model, coatings
        self.shapes: list[Any] = []
        self.clear = False
        """One of them is glass or water."""
        self.passing: list[tuple[Any, tuple[float, float, float]]] = []
        """Those that light goes through, with what it loses there, 1/m."""
        self._params: dict[tuple[str, int, int], tuple[Any, int]] = {}
        self.points: dict[tuple[str, int, int], np.ndarray] = {}
        """Where the corners of each are, (V, 3) m."""
        self._soft = SoftShapes(model)
        self._unit = rounded.capsule(1.0, 0.0, 12)
        for patch in self._read(data):
            self._make(patch)

    def _make(self, patch: Patch) -> None:
        finish = of_material(self.model, patch.material) if patch.material >= 0 else plain(patch.rgba)
        tint = linear(np.asarray(finish.look.rgba)[:3])
        pictured = patch.uv is not None and finish.texture >= 0 and not finish.look.around
        if (finish.look.paint or finish.texture >= 0) and not pictured:  # these bring no coordinates for a picture
            finish, tint = plain((*(np.asarray(finish.mean) ** (1 / 2.2)), 1.0)), np.asarray(finish.mean)
        self.clear |= finish.look.clear > 0
        coloured = patch.colours is not None
        wall = self._soft.is_wall(patch, finish.look)
        coating = self._coatings.of(finish, tint, 1.0, corners=coloured, sheet=wall)
        room = len(patch.points)
        if patch.key[0] == "tendon":
            one = len(self._unit.points)
            parts = room // one + SPARE
            faces = np.concatenate([self._unit.faces + k * one for k in range(parts)])
            room = parts * one
        else:
            faces = np.arange(room).reshape(-1, 3)
        uv = np.zeros((room, 2)) if patch.uv is None else patch.uv
        shape, params = mesh_of(room, faces, uv, coating, np.zeros(3), coloured)
        self._params[patch.key] = (params, room)
        self.shapes.append(shape)
        if lets_through(coating):
            self.passing.append((shape, NOTHING if wall else finish.look.absorbs))

    def _read(self, data: mujoco.MjData) -> list[Patch]:
        """Everything that is soft, the strands of one material together."""
        strands, patches = self._soft.read(data)
        groups: dict[int, list[Strand]] = {}
        for strand in strands:
            groups.setdefault(strand.material, []).append(strand)
        for material, group in groups.items():
            points = np.concatenate([self._capsule(one) for one in group])
            normals = np.concatenate([self._unit.normals @ one.turn.T for one in group])
            patches.append(Patch(("tendon", material, 0), points, normals, None, material, group[-1].rgba, -1))
        return patches

    def _capsule(self, strand: Strand) -> np.ndarray:
        points = self._unit.points * strand.radius
        points[:, 2] += np.where(self._unit.normals[:, 2] >= 0, 1.0, -1.0) * strand.half
        return points @ strand.turn.T + strand.place

    def place(self, data: mujoco.MjData) -> bool:
        """Take over the shapes of `data`; returns whether there are any."""
        if not self._params:
            return False
        for patch in self._read(data):
            if patch.key not in self._params:
                continue
            params, room = self._params[patch.key]
            points, normals = patch.points[:room], patch.normals[:room]
            spare = room - len(points)
            if spare:
                points = np.concatenate([points, np.full((spare, 3), NOWHERE)])
                normals = np.concatenate([normals, np.tile([0.0, 0.0, 1.0], (spare, 1))])
            fill(params, points, normals, patch.colours)
            self.points[patch.key] = points
        return True

    def moved(
        self, before: dict[Any, np.ndarray], now: dict[Any, np.ndarray]
    ) -> Iterator[tuple[np.ndarray, np.ndarray]]:
        """The points (V, 3), m, of each that changed, at both moments; those of a tendon piece by piece."""
        for key, points in now.items():
            if np.array_equal(points, before[key]):
                continue
            if key[0] == "tendon":
                piece = len(self._unit.points)
                yield from zip(before[key].reshape(-1, piece, 3), points.reshape(-1, piece, 3), strict=True)
            else:
                yield before[key][before[key][:, 2] > NOWHERE / 2], points[points[:, 2] > NOWHERE / 2]
