"""Things whose shape comes from MuJoCo's own scene, as meshes of their own for each frame: tendons, flexes and skins."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ..preview.finish import linear, of_material, plain
from . import rounded
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
        self._params: dict[tuple[str, int], tuple[Any, int]] = {}
        if not (model.ntendon or model.nflex or model.nskin):
            return
        import mujoco

        self._scene = mujoco.MjvScene(model, maxgeom=20000)
        self._options = mujoco.MjvOption()
        self._options.geomgroup[:] = 0
        self._options.sitegroup[:] = 0
        self._unit = rounded.capsule(1.0, 0.0, 12)
        for key, points, normals, material, rgba in self._read(data):
            self._make(key, points, normals, material, rgba)

    def _make(
        self, key: tuple[str, int], points: np.ndarray, normals: np.ndarray, material: int, rgba: np.ndarray
    ) -> None:
        finish = of_material(self.model, material) if material >= 0 else plain(rgba)
        tint = linear(np.asarray(finish.look.rgba)[:3]) if material >= 0 else linear(np.asarray(rgba)[:3])
        if finish.look.paint or finish.texture >= 0:  # these bring no coordinates for a picture
            finish, tint = plain((*(np.asarray(finish.mean) ** (1 / 2.2)), 1.0)), np.asarray(finish.mean)
        self.clear |= finish.look.clear > 0
        coating = self._coatings.of(finish, tint, 1.0)
        if key[0] == "tendon":
            one = len(self._unit.points)
            parts = len(points) // one + SPARE
            faces = np.concatenate([self._unit.faces + k * one for k in range(parts)])
            room = parts * one
        else:
            faces, room = np.arange(len(points)).reshape(-1, 3), len(points)
        shape, params = mesh_of(room, faces, np.zeros((room, 2)), coating, np.zeros(3))
        self._params[key] = (params, room)
        self.shapes.append(shape)

    def _read(self, data: mujoco.MjData) -> list[tuple[tuple[str, int], np.ndarray, np.ndarray, int, np.ndarray]]:
        """(kind and number, points, normals, material, colour) of everything that is soft, in the world frame."""
        import mujoco

        model, scene = self.model, self._scene
        mujoco.mjv_updateScene(
            model, data, self._options, mujoco.MjvPerturb(), mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene
        )
        found: list[tuple[tuple[str, int], np.ndarray, np.ndarray, int, np.ndarray]] = []
        strands: dict[int, list[tuple[np.ndarray, np.ndarray]]] = {}
        colours: dict[int, np.ndarray] = {}
        for number in range(scene.ngeom):
            geom = scene.geoms[number]
            kind = geom.type
            if geom.objtype == mujoco.mjtObj.mjOBJ_TENDON and kind in (
                mujoco.mjtGeom.mjGEOM_CAPSULE, mujoco.mjtGeom.mjGEOM_CYLINDER,
            ):  # fmt: skip
                strands.setdefault(int(geom.matid), []).append(self._capsule(geom))
                colours[int(geom.matid)] = np.array(geom.rgba)
            elif kind == mujoco.mjtGeom.mjGEOM_FLEX and scene.flexfaceused[geom.objid]:
                start, count = int(scene.flexfaceadr[geom.objid]), int(scene.flexfaceused[geom.objid])
                points = np.array(scene.flexface).reshape(-1, 9)[start : start + count].reshape(-1, 3)
                normals = np.array(scene.flexnormal).reshape(-1, 9)[start : start + count].reshape(-1, 3)
                material = int(geom.matid)
                material = material if material >= 0 else int(model.flex_matid[model.flex_elemadr[geom.objid]])
                found.append((("flex", int(geom.objid)), points, normals, material, np.array(geom.rgba)))
            elif kind == mujoco.mjtGeom.mjGEOM_SKIN:
                skin = int(geom.objid)
                start, count = int(scene.skinvertadr[skin]), int(scene.skinvertnum[skin])
                first, faces = int(model.skin_faceadr[skin]), int(model.skin_facenum[skin])
                index = model.skin_face[first : first + faces].ravel()
                points = np.array(scene.skinvert).reshape(-1, 3)[start : start + count][index]
                normals = np.array(scene.skinnormal).reshape(-1, 3)[start : start + count][index]
                found.append((("skin", skin), points, normals, int(geom.matid), np.array(geom.rgba)))
        for material, parts in strands.items():
            points = np.concatenate([part[0] for part in parts])
            normals = np.concatenate([part[1] for part in parts])
            found.append((("tendon", material), points, normals, material, colours[material]))
        return found

    def _capsule(self, geom: Any) -> tuple[np.ndarray, np.ndarray]:
        rotation = np.array(geom.mat, dtype=float).reshape(3, 3)
        points = self._unit.points * float(geom.size[0])
        points[:, 2] += np.where(self._unit.normals[:, 2] >= 0, 1.0, -1.0) * float(geom.size[2])
        return points @ rotation.T + np.array(geom.pos), self._unit.normals @ rotation.T

    def place(self, data: mujoco.MjData) -> bool:
        """Take over the shapes of `data`; returns whether there are any."""
        if not self._params:
            return False
        for key, points, normals, _, _ in self._read(data):
            if key not in self._params:
                continue
            params, room = self._params[key]
            points, normals = points[:room], normals[:room]
            spare = room - len(points)
            if spare:
                points = np.concatenate([points, np.full((spare, 3), NOWHERE)])
                normals = np.concatenate([normals, np.tile([0.0, 0.0, 1.0], (spare, 1))])
            fill(params, points, normals)
        return True
