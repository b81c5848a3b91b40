"""Draw things whose shape comes from MuJoCo's own scene: tendons, flexes and skins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from . import gl
from .finish import Finish, linear, of_material, plain
from .things import FLOATS, SIDE_MODE

if TYPE_CHECKING:
    import mujoco


def _row(finish: Finish, rgba: np.ndarray, number: float = -1.0) -> np.ndarray:
    entry, row = finish.look, np.zeros(FLOATS, dtype=np.float32)
    row[[0, 5, 10]] = 1.0
    row[12:15] = 1.0
    row[16:20] = *linear(rgba[:3]), 1.0
    row[20:24] = entry.roughness, entry.metallic, entry.coat, entry.sheen
    row[24:28] = 1.0 / entry.tile_m, entry.relief_m, SIDE_MODE, 0.0
    row[28:32] = number, entry.emission, 1.0, 0.0
    row[32:36] = 0.18, 0.18, 0.18, -1e3
    row[38] = 1e3
    return row


class Soft:
    """Draws tendons as capsules, flexes and skins as triangles; `rows` has their rows in the order of `draws`."""

    def __init__(self, model: mujoco.MjModel):
        self.model = model
        self.rows = np.zeros((0, FLOATS), dtype=np.float32)
        self._any = bool(model.ntendon or model.nflex or model.nskin)
        self._draws: list[tuple[gl.Shape | None, int, int, Finish]] = []
        self._triangles: dict[tuple[str, int, int], gl.Shape] = {}
        if not self._any:
            return
        import mujoco

        self._scene = mujoco.MjvScene(model, maxgeom=20000)
        self._camera, self._perturbation = mujoco.MjvCamera(), mujoco.MjvPerturb()
        self._options = mujoco.MjvOption()
        self._options.geomgroup[:] = 0
        self._options.sitegroup[:] = 0
        self._finishes = {i: of_material(model, i) for i in range(model.nmat)}

    def _finish(self, material: int, rgba: np.ndarray) -> tuple[Finish, np.ndarray]:
        finish = self._finishes.get(int(material))
        return (finish, np.array(finish.look.rgba)) if finish else (plain(rgba), np.asarray(rgba))

    def _flex_material(self, flex: int, material: int) -> int:
        """A flex's material: MuJoCo 4 keeps one for each element, and its scene names none; the first one counts."""
        return material if material >= 0 else int(self.model.flex_matid[self.model.flex_elemadr[flex]])

    def _triangle_shape(self, kind: str, index: int, points: np.ndarray, normals: np.ndarray) -> gl.Shape:
        vertices = np.zeros((len(points), 9), dtype=np.float32)
        vertices[:, :3], vertices[:, 4:7] = points, normals
        key = (kind, index, len(points))
        if key not in self._triangles:
            self._triangles[key] = gl.Shape(vertices, np.arange(len(points)).reshape(-1, 3), dynamic=True)
        else:
            self._triangles[key].fill(vertices)
        return self._triangles[key]

    def update(self, data: mujoco.MjData) -> None:
        """Take over the shapes of `data`."""
        if not self._any:
            return
        import mujoco

        model, scene = self.model, self._scene
        mujoco.mjv_updateScene(
            model, data, self._options, self._perturbation, self._camera, mujoco.mjtCatBit.mjCAT_ALL, scene
        )
        rows: list[np.ndarray] = []
        self._draws = []
        strands: dict[int, list[np.ndarray]] = {}
        for i in range(scene.ngeom):
            geom = scene.geoms[i]
            kind = geom.type
            if geom.objtype == mujoco.mjtObj.mjOBJ_TENDON and kind in (
                mujoco.mjtGeom.mjGEOM_CAPSULE,
                mujoco.mjtGeom.mjGEOM_CYLINDER,
            ):
                finish, rgba = self._finish(geom.matid, geom.rgba)
                row = _row(finish, rgba)
                frame = row[:12].reshape(3, 4)
                frame[:, :3], frame[:, 3] = np.array(geom.mat).reshape(3, 3), geom.pos
                row[12:16] = geom.size[0], geom.size[0], geom.size[0], geom.size[2]
                strands.setdefault(int(geom.matid), []).append(row)
            elif kind == mujoco.mjtGeom.mjGEOM_FLEX and scene.flexfaceused[geom.objid]:
                start, count = int(scene.flexfaceadr[geom.objid]), int(scene.flexfaceused[geom.objid])
                points = np.array(scene.flexface).reshape(-1, 9)[start : start + count].reshape(-1, 3)
                normals = np.array(scene.flexnormal).reshape(-1, 9)[start : start + count].reshape(-1, 3)
                finish, rgba = self._finish(self._flex_material(int(geom.objid), int(geom.matid)), geom.rgba)
                self._draws.append(
                    (self._triangle_shape("flex", int(geom.objid), points, normals), len(rows), 1, finish)
                )
                rows.append(_row(finish, rgba))
            elif kind == mujoco.mjtGeom.mjGEOM_SKIN:
                skin = int(geom.objid)
                start, count = int(scene.skinvertadr[skin]), int(scene.skinvertnum[skin])
                first, faces = int(model.skin_faceadr[skin]), int(model.skin_facenum[skin])
                index = model.skin_face[first : first + faces].ravel()
                points = np.array(scene.skinvert).reshape(-1, 3)[start : start + count][index]
                normals = np.array(scene.skinnormal).reshape(-1, 3)[start : start + count][index]
                finish, rgba = self._finish(geom.matid, geom.rgba)
                self._draws.append((self._triangle_shape("skin", skin, points, normals), len(rows), 1, finish))
                rows.append(_row(finish, rgba))
        for material, group in strands.items():
            finish = self._finish(material, np.array([0.5, 0.5, 0.5, 1.0]))[0]
            self._draws.append((None, len(rows), len(group), finish))
            rows.extend(group)
        self.rows = np.array(rows, dtype=np.float32).reshape(-1, FLOATS)

    def draws(self) -> Iterator[tuple[gl.Shape | None, int, int, Finish]]:
        """Shape (None: a capsule), first row, count and finish of each group."""
        yield from self._draws
