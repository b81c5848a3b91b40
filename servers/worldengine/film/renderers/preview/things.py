"""Turn the visible geoms of a model, grouped by shape and picture, into rows of numbers for the shaders.

A row is ten texels of four floats; see `shaders/thing.vert` and `shaders/surface.frag` for their meaning.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from worldkit.materials.look import Look
from worldkit.turning import matrices

from ....recording.seen import UNSET_RGBA, geom_rgba, shown_rgba, skinned
from ... import round_things, swaying
from . import mean_chord
from .finish import Finish, linear, of_material, plain

if TYPE_CHECKING:
    import mujoco

FLOATS = 40
VISIBLE_GROUPS = (0, 1, 2)
"""Geom groups that are drawn, as in MuJoCo's own viewers; collision hulls lie in group 3."""
ENDLESS_M = 4096.0
SIDE_MODE, EXACT_UV, FLAT_UV = 2.0, 6.0, 7.0
PANE, SLIM = 11.0, 0.25
"""From here on, the kind of a clear mesh that is a pane, and the axis across it; so thin, by its second side, is a pane."""
GOLDEN, SHIFTS = 0.6180339887, 512.0
"""Shares of the golden section never meet again; so many tiles on, the paint of two things has nothing in common."""
PIECES = (0.0, 0.7, -0.4, 0.3, -1.0, 1.0, -0.7)
"""How much of what pieces may differ each does, by turns: few, so that few materials are made of one look. The first body of a
world has its look's own tone, and so has all ground."""


@dataclass
class Batch:
    """Things of one shape under one picture."""

    shape: tuple[str, int]
    """Kind of the shape, and its index for meshes and height fields."""
    finish: Finish
    clear: bool
    rows: list[int] = field(default_factory=list)
    first: int = 0


def _upright(model: mujoco.MjModel, geom: int) -> float:
    """The paint mode in which courses of bricks lie level in the frame that a thing was made in; that of a mesh is not its geom's."""
    import mujoco

    mesh = int(model.geom_dataid[geom])
    if model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_MESH or mesh < 0:
        return SIDE_MODE
    up = np.abs(matrices(model.mesh_quat[mesh])[2])
    return (3.0, 4.0, SIDE_MODE)[int(up.argmax())]


def _longest(size: np.ndarray) -> float:
    """The paint mode that lays the grain along the longest side (2 x, 3 y, 4 z)."""
    return SIDE_MODE + float(np.argmax(size))


def _traits(look: Look) -> tuple[object, ...]:
    """The traits that plain looks must share to be drawn together."""
    glossy = look.roughness < 0.3 and (look.metallic > 0.5 or look.coat >= 0.4)
    clear = (look.index, look.absorbs) if look.clear > 0 else ()
    return (look.coat > 0, look.sheen > 0, look.mark, look.vary > 0, look.clear > 0, glossy, *clear)


def pieces(model: mujoco.MjModel) -> np.ndarray:
    """(nbody,) int: the piece of material that each body is of, named by the first of its bodies.

    Bodies that are joined rigidly, or by welds and connections that hold at the start, are one, until they break too. What stands
    fixed in the world is a piece for each body, and joins nothing.
    """
    import mujoco

    rigid = np.array(model.body_weldid)
    found = np.where(rigid == 0, np.arange(model.nbody), rigid)
    kinds = (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD)
    for index in np.flatnonzero(np.isin(model.eq_type, [int(kind) for kind in kinds]) & (model.eq_active0 != 0)):
        ends = np.array([model.eq_obj1id[index], model.eq_obj2id[index]])
        if model.eq_objtype[index] == mujoco.mjtObj.mjOBJ_SITE:
            ends = model.site_bodyid[ends]
        if rigid[ends].all():
            one, other = sorted(found[ends])
            found[found == other] = one
    return found


class Things:
    """The geoms of a model that can be seen.

    `rows` (N, 40) float32 holds every thing; `update` moves them to the poses in an MjData.
    """

    def __init__(self, model: mujoco.MjModel):
        import mujoco

        self.model = model
        self._skinned = skinned(model)
        kinds = mujoco.mjtGeom
        self._pieces = pieces(model)
        self._finishes = {-1: plain(UNSET_RGBA)} | {i: of_material(model, i) for i in range(model.nmat)}
        shown = np.isin(model.geom_group, VISIBLE_GROUPS) & (geom_rgba(model)[:, 3] > 0.003)
        self.geoms = np.flatnonzero(shown)
        self.rows = np.zeros((len(self.geoms), FLOATS), dtype=np.float32)
        self.batches: list[Batch] = []
        self.ground = -1
        """Row of the first horizontal endless plane, or -1."""
        groups: dict[tuple, Batch] = {}
        names = {
            kinds.mjGEOM_PLANE: "plane", kinds.mjGEOM_SPHERE: "sphere", kinds.mjGEOM_ELLIPSOID: "sphere",
            kinds.mjGEOM_CAPSULE: "capsule", kinds.mjGEOM_CYLINDER: "cylinder", kinds.mjGEOM_BOX: "box",
            kinds.mjGEOM_MESH: "mesh", kinds.mjGEOM_SDF: "mesh", kinds.mjGEOM_HFIELD: "hfield",
        }  # fmt: skip
        for row, geom in enumerate(self.geoms):
            kind = kinds(model.geom_type[geom])
            shape = (names[kind], int(model.geom_dataid[geom]) if names[kind] in ("mesh", "hfield") else -1)
            endless = kind == kinds.mjGEOM_PLANE and model.geom_size[geom, :2].min() <= 0
            if endless:
                shape = ("disc", -1)
                level = model.geom_bodyid[geom] == 0 or model.body_weldid[model.geom_bodyid[geom]] == 0
                if self.ground < 0 and level:
                    self.ground = row
            finish, rgba = self.finish(geom), self._rgba(geom)
            clear = finish.look.clear > 0 or rgba[3] < 0.997
            self._fill(row, int(geom), kind, finish, rgba, endless)
            picture = (
                (finish.look, finish.texture) if finish.texture >= 0 or finish.look.paint else _traits(finish.look)
            )
            batch = groups.setdefault((shape, picture, clear), Batch(shape, finish, clear))
            batch.rows.append(row)
        self.batches = sorted(groups.values(), key=lambda b: b.shape[0] == "disc")
        # Rows of a batch must lie side by side.
        order = [row for batch in self.batches for row in batch.rows]
        if order:
            self.rows, self.geoms = self.rows[order], self.geoms[order]
            self.ground = order.index(self.ground) if self.ground >= 0 else -1
        start = 0
        for batch in self.batches:
            batch.first = start
            batch.rows = list(range(start, start + len(batch.rows)))
            start += len(batch.rows)
        self._glossy = [
            i for i, g in enumerate(self.geoms) if i != self.ground and model.geom_type[g] != kinds.mjGEOM_PLANE
        ]
        self._swaying = np.flatnonzero(np.isin(self.geoms, sorted(swaying.geoms(model))))
        self.breeze: tuple[float, float, float] | None = None
        """The wind towards x and y, m/s, and the time, s."""
        self._balls = np.flatnonzero(model.geom_type[self.geoms] == int(kinds.mjGEOM_SPHERE))
        turned = np.isin(model.geom_type[self.geoms], [int(kinds.mjGEOM_CYLINDER), int(kinds.mjGEOM_CAPSULE)])
        self.rounds = np.where(turned, round_things.ABOUT_Z, round_things.NOT)
        self.rounds[self._balls] = round_things.ALL_ROUND
        """How each thing is round, by `round_things`."""
        self._supports_of_fixed = False

    def _rgba(self, geom: int) -> np.ndarray:
        material, own = int(self.model.geom_matid[geom]), self.model.geom_rgba[geom]
        return np.asarray(own if material < 0 else shown_rgba(own, self.model.mat_rgba[material]))

    def finish(self, geom: int) -> Finish:
        """The finish of a geom."""
        material = int(self.model.geom_matid[geom])
        return self._finishes[material] if material >= 0 else plain(self._rgba(geom))

    def _fill(self, row: int, geom: int, kind: mujoco.mjtGeom, finish: Finish, rgba: np.ndarray, endless: bool) -> None:
        import mujoco

        kinds, entry, out = mujoco.mjtGeom, finish.look, self.rows[row]
        size = self.model.geom_size[geom].astype(float)
        full = size.copy()
        half = 0.0
        if kind == kinds.mjGEOM_SPHERE:
            full[:] = size[0]
        elif kind == kinds.mjGEOM_CYLINDER:
            full[:] = size[0], size[0], size[1]
        elif kind == kinds.mjGEOM_CAPSULE:
            full[:], half = size[0], size[1]
        elif kind == kinds.mjGEOM_PLANE:
            full[:] = (ENDLESS_M, ENDLESS_M, -1.0) if endless else (size[0], size[1], 1.0)
        elif kind in (kinds.mjGEOM_MESH, kinds.mjGEOM_SDF, kinds.mjGEOM_HFIELD):
            full[:] = 1.0
        out[12:16] = *full, half
        body = int(self.model.geom_bodyid[geom])
        piece = 0 if kind in (kinds.mjGEOM_PLANE, kinds.mjGEOM_HFIELD) else int(self._pieces[body]) or geom
        out[16:19] = linear(rgba[:3]) * (1.0 + entry.apart * PIECES[max(piece - 1, 0) % len(PIECES)])
        out[19] = rgba[3]
        out[20:24] = entry.roughness, entry.metallic, entry.coat, entry.sheen
        extents = self.model.geom_aabb[geom, 3:]
        out[24:28] = self._weave(geom, finish, extents, endless)
        bevel = 0.0
        if kind in (kinds.mjGEOM_BOX, kinds.mjGEOM_CYLINDER) and entry.clear == 0:
            bevel = float(np.clip(0.035 * full.min(), 0.0004, 0.008))
        elif kind in (kinds.mjGEOM_MESH, kinds.mjGEOM_SDF) and entry.clear > 0:
            bevel = mean_chord.radius(self.model, int(self.model.geom_dataid[geom]))
        elif kind == kinds.mjGEOM_CAPSULE and entry.clear > 0:
            bevel = mean_chord.of_capsule(size[0], size[1])
        out[28:32] = geom, entry.emission, 0.0, bevel
        out[30] = geom / max(self.model.ngeom, 1)
        shapes = {
            kinds.mjGEOM_SPHERE: 1.0,
            kinds.mjGEOM_ELLIPSOID: 1.0,
            kinds.mjGEOM_BOX: 2.0,
            kinds.mjGEOM_CYLINDER: 3.0,
        }
        shape = 4.0 if endless else shapes.get(kind, 0.0)
        thin, second, _ = np.sort(extents)
        if entry.clear > 0 and kind in (kinds.mjGEOM_MESH, kinds.mjGEOM_SDF) and thin < SLIM * second:
            shape = PANE + int(extents.argmin())
        out[36:40] = entry.vary, entry.clear, float(entry.mark), shape

    def _weave(
        self, geom: int, finish: Finish, extents: np.ndarray, endless: bool
    ) -> tuple[float, float, float, float]:
        """Repeats per metre, relief, paint mode and a phase of its own for each geom."""
        import mujoco

        entry = finish.look
        seed = 0.0 if endless else SHIFTS * (geom * GOLDEN % 1.0)
        if finish.texture < 0:
            mode = _longest(extents) if entry.grain else _upright(self.model, geom)
            return (1.0 / entry.tile_m, entry.relief_m, mode, seed)
        if entry.around:
            return (1.0, 0.0, SIDE_MODE, 0.0)
        mesh = int(self.model.geom_dataid[geom])
        kind = self.model.geom_type[geom]
        if kind == mujoco.mjtGeom.mjGEOM_MESH and mesh >= 0 and self.model.mesh_texcoordnum[mesh] > 0:
            return (1.0, 0.0, EXACT_UV, 0.0)
        a, b = finish.repeat
        if endless or finish.uniform:
            return (a / 2.0 if endless and not finish.uniform else a, 0.0, SIDE_MODE, seed)
        return (a / max(2 * extents[0], 1e-6), b / max(2 * extents[1], 1e-6), FLAT_UV, 0.0)

    def update(self, data: mujoco.MjData) -> None:
        """Take over the poses of `data`, and find anew the surface below each thing."""
        rotation = data.geom_xmat[self.geoms].reshape(-1, 3, 3)
        frame = self.rows[:, :12].reshape(-1, 3, 4)
        frame[:, :, :3] = rotation
        frame[:, :, 3] = data.geom_xpos[self.geoms]
        self.rows[self._balls, 12:15] = self.model.geom_size[self.geoms[self._balls], :1]
        if len(self._swaying) and self.breeze is not None:
            x, y, time = self.breeze
            self.rows[self._swaying, 15], self.rows[self._swaying, 31] = x, y
            self.rows[self._swaying, 39] = swaying.FLAG + time
        self._support(data)

    def _support(self, data: mujoco.MjData) -> None:
        """Find colour and height of the next surface below each thing, which tints its underside and mirrors in it."""
        import mujoco

        down = np.array([0.0, 0.0, -1.0])
        groups = np.array([i in VISIBLE_GROUPS for i in range(6)], dtype=np.uint8)
        hit = np.zeros(1, dtype=np.int32)
        fixed = self.model.body_weldid[self.model.geom_bodyid[self.geoms]] == 0
        for row in self._glossy:
            if fixed[row] and self._supports_of_fixed:
                continue
            geom = self.geoms[row]
            body = int(self.model.geom_bodyid[geom])
            start = np.array(data.geom_xpos[geom], dtype=float)
            if body == 0:
                start[2] -= self.model.geom_rbound[geom] + 1e-4
            distance = mujoco.mj_ray(self.model, data, start, down, groups, True, body or -1, hit)
            mean = self.finish(int(hit[0])).mean if distance >= 0 else (0.18, 0.18, 0.18)
            self.rows[row, 32:35] = mean
            self.rows[row, 35] = start[2] - distance if distance >= 0 else start[2] - 1e3
            wide = distance >= 0 and self.model.geom_rbound[hit[0]] > 0
            self.rows[row, 38] = max(float(self.model.geom_aabb[hit[0], 3:].max()), 1e-3) if wide else 1e3
        self._supports_of_fixed = True

    def bounds(self, data: mujoco.MjData) -> tuple[np.ndarray, np.ndarray]:
        """Corners (3,), m, of the box around all but endless planes; a metre cube at the origin if there is nothing.

        What a skin is drawn over counts by its geoms, which lie below it.
        """
        below = np.flatnonzero(self._skinned[self.model.geom_bodyid])
        finite = [g for g in np.union1d(self.geoms, below) if self.model.geom_rbound[g] > 0]
        if not finite:
            return np.array([-0.5, -0.5, 0.0]), np.array([0.5, 0.5, 1.0])
        rotation = np.abs(data.geom_xmat[finite].reshape(-1, 3, 3))
        turned = data.geom_xmat[finite].reshape(-1, 3, 3)
        centre = data.geom_xpos[finite] + np.einsum("nij,nj->ni", turned, self.model.geom_aabb[finite, :3])
        half = np.einsum("nij,nj->ni", rotation, self.model.geom_aabb[finite, 3:])
        return (centre - half).min(axis=0), (centre + half).max(axis=0)
