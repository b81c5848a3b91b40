"""Draw things whose shape comes from MuJoCo's own scene: tendons, flexes and skins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from . import gl
from .finish import Finish, linear, of_material, plain
from .soft_shapes import Patch, SoftShapes
from .things import EXACT_UV, FLOATS, SIDE_MODE

if TYPE_CHECKING:
    import mujoco


BEAD_M = 0.004
"""Half the width of a drop, about, by which it bends light."""
LIQUID = 9.0
"""The kind of shape of what is clear and closed, by which the shader knows it."""
WALL = 10.0
"""That of what is clear and a thin wall around air."""
TOLD = 8.0
"""The kind of what is clear and tells at each corner how thick it is there."""


def _row(
    finish: Finish,
    rgba: np.ndarray,
    geom: int = -1,
    pictured: bool = False,
    half: float = 0.0,
    middle: np.ndarray | None = None,
    wall: bool = False,
) -> np.ndarray:
    """The numbers of one thing; `half` its half width, m, which what is clear bends light by; `middle` of a body of liquid."""
    entry, row = finish.look, np.zeros(FLOATS, dtype=np.float32)
    row[[0, 5, 10]] = 1.0
    row[12:15] = 1.0
    row[16:20] = *linear(rgba[:3]), 1.0
    row[20:24] = entry.roughness, entry.metallic, entry.coat, entry.sheen
    row[24:28] = (1.0, 0.0, EXACT_UV, 0.0) if pictured else (1.0 / entry.tile_m, entry.relief_m, SIDE_MODE, 0.0)
    row[28:32] = geom, entry.emission, 1.0, half if entry.clear > 0 else 0.0
    row[32:36] = 0.18, 0.18, 0.18, -1e3
    row[37:39] = entry.clear, 1e3
    if wall:
        row[39] = WALL
    elif entry.clear > 0 and middle is not None:
        row[24:27], row[39] = middle, LIQUID
    return row


class Soft:
    """Draws tendons as capsules, flexes and skins as triangles; `rows` has their rows in the order of `draws`, `balls` what is around each."""

    def __init__(self, model: mujoco.MjModel):
        self._shapes = SoftShapes(model)
        self.rows = np.zeros((0, FLOATS), dtype=np.float32)
        self.balls = np.zeros((0, 4))
        """Middle and radius, m, the radius infinite where nobody looked."""
        self._draws: list[tuple[gl.Shape | None, int, int, Finish]] = []
        self._triangles: dict[tuple[str, int, int, int, int], gl.Shape] = {}
        self._finishes = {i: of_material(model, i) for i in range(model.nmat)} if self._shapes.any else {}

    def _finish(self, material: int, rgba: np.ndarray) -> tuple[Finish, np.ndarray]:
        finish = self._finishes.get(material)
        return (finish, np.array(finish.look.rgba)) if finish else (plain(rgba), rgba)

    def _shape(self, patch: Patch) -> gl.Shape:
        vertices = np.zeros((len(patch.points), 9 if patch.colours is None else 12), dtype=np.float32)
        vertices[:, :3], vertices[:, 4:7] = patch.points, patch.normals
        if patch.thick is not None:
            vertices[:, 3] = patch.thick  # a soft row has no length that this place would reach along
        if patch.uv is not None:
            vertices[:, 7], vertices[:, 8] = patch.uv[:, 0], 1.0 - patch.uv[:, 1]  # our v runs up
        if patch.colours is not None:
            vertices[:, 9:] = patch.colours
        key = (*patch.key, *vertices.shape)
        if key not in self._triangles:
            self._triangles[key] = gl.Shape(vertices, np.arange(len(vertices)).reshape(-1, 3), dynamic=True)
        else:
            self._triangles[key].fill(vertices)
        return self._triangles[key]

    def update(self, data: mujoco.MjData) -> None:
        """Take over the shapes of `data`."""
        if not self._shapes.any:
            return
        rows: list[np.ndarray] = []
        balls: list[np.ndarray] = []
        self._draws = []
        strands, patches = self._shapes.read(data)
        for patch in patches:
            finish, rgba = self._finish(patch.material, patch.rgba)
            pictured = patch.uv is not None and finish.texture >= 0 and not finish.look.around
            self._draws.append((self._shape(patch), len(rows), 1, finish))
            low, high = patch.points.min(axis=0), patch.points.max(axis=0)
            half, middle = float(np.sort(high - low)[1]) / 2, None
            balls.append(np.append((low + high) / 2, np.linalg.norm(high - low) / 2))
            if patch.key[0] == "flex" and self._shapes.is_closed(patch.key[1]):
                half, middle = (BEAD_M, None) if patch.key[2] else self._shapes.around(patch.key[1])
            tint = rgba if patch.colours is None else np.ones(4)
            rows.append(
                _row(finish, tint, patch.geom, pictured, half, middle, self._shapes.is_wall(patch, finish.look))
            )
            if patch.thick is not None and finish.look.clear > 0:
                rows[-1][39] = TOLD
        groups: dict[int, list[np.ndarray]] = {}
        for strand in strands:
            row = _row(*self._finish(strand.material, strand.rgba))
            frame = row[:12].reshape(3, 4)
            frame[:, :3], frame[:, 3] = strand.turn, strand.place
            row[12:16] = strand.radius, strand.radius, strand.radius, strand.half
            groups.setdefault(strand.material, []).append(row)
        for material, group in groups.items():
            finish = self._finish(material, np.array([0.5, 0.5, 0.5, 1.0]))[0]
            self._draws.append((None, len(rows), len(group), finish))
            rows.extend(group)
        self.rows = np.array(rows, dtype=np.float32).reshape(-1, FLOATS)
        self.balls = np.full((len(rows), 4), np.inf)
        self.balls[: len(balls)] = np.reshape(balls, (-1, 4))

    def draws(self) -> Iterator[tuple[gl.Shape | None, int, int, Finish]]:
        """Shape (None: a capsule), first row, count and finish of each group."""
        yield from self._draws
