"""Read what MuJoCo's own scene alone knows the shape of: tendons as strands, flexes and skins as triangles, in the world."""

from __future__ import annotations

import copy
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from worldkit.materials.look import Look
from worldkit.moved_shapes import at_rest

from ....recording import point_colours
from .closed_flexes import ClosedFlex, closed
from .finish import of_material

if TYPE_CHECKING:
    import mujoco

FLEX = -2
"""In a segmentation the first flex has this number, the next one less."""
SMOOTH = 0.8
"""Cosine between the normals of two corners in one place up to which they are one, parted by the edge of a picture only."""


class Strand(NamedTuple):
    """A straight piece of a tendon, a capsule."""

    material: int
    rgba: np.ndarray
    place: np.ndarray
    """(3,) m, of its middle."""
    turn: np.ndarray
    """(3, 3)."""
    radius: float
    half: float
    """Half its length without the caps, m."""


class Patch(NamedTuple):
    """Triangles of one look and one owner, each with three corners of its own."""

    key: tuple[str, int, int]
    """Kind (`flex`, `skin`), its number, and which piece of it this is."""
    points: np.ndarray
    """(3 N, 3) m."""
    normals: np.ndarray
    """(3 N, 3)."""
    uv: np.ndarray | None
    """(3 N, 2) places in its picture, along and down the rows."""
    material: int
    rgba: np.ndarray
    geom: int
    """A geom of the body that it belongs to, or -1; of a flex `FLEX` less its number."""
    colours: np.ndarray | None = None
    """(3 N, 3) scene-linear, in place of its material's; None where it has none of its own."""
    thick: np.ndarray | None = None
    """(3 N,) m: how far it is straight in to the other side; None where nobody told."""


@dataclass(frozen=True)
class _Skin:
    uv: np.ndarray | None
    seams: np.ndarray | None
    """(V,) which place each corner lies in, where a picture parts corners of one place."""
    pieces: tuple[tuple[int, np.ndarray], ...]
    """Of each owner a geom, and which (N,) triangles are its; a film fills some skins anew, so what they are is read then."""


class SoftShapes:
    """Reads the tendons, flexes and skins of one model; `any` tells whether there are some."""

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model = model
        self.any = bool(model.ntendon or model.nflex or model.nskin)
        if not self.any:
            return
        import mujoco

        self._scene = mujoco.MjvScene(model, maxgeom=20000)
        self._options = mujoco.MjvOption()
        self._options.geomgroup[:] = 0
        self._options.sitegroup[:] = 0
        self._skins = [_skin(model, skin) for skin in range(model.nskin)]
        self._closed: dict[int, ClosedFlex | None] = {flex: None for flex in range(model.nflex) if closed(model, flex)}
        self._corners: list[np.ndarray] | None = None

    def read(self, data: mujoco.MjData) -> tuple[list[Strand], list[Patch]]:
        """All of them in the state `data`."""
        if not self.any:
            return [], []
        import mujoco

        model, scene, kinds = self.model, self._scene, mujoco.mjtGeom
        mujoco.mjv_updateScene(
            model, data, self._options, mujoco.MjvPerturb(), mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene
        )
        strands: list[Strand] = []
        patches: list[Patch] = []
        for geom in (scene.geoms[number] for number in range(scene.ngeom)):
            number, material, rgba = int(geom.objid), int(geom.matid), np.array(geom.rgba)
            if geom.objtype == mujoco.mjtObj.mjOBJ_TENDON and geom.type in (
                kinds.mjGEOM_CAPSULE,
                kinds.mjGEOM_CYLINDER,
            ):
                turn = np.array(geom.mat, dtype=float).reshape(3, 3)
                size = float(geom.size[0]), float(geom.size[2])
                strands.append(Strand(material, rgba, np.array(geom.pos, dtype=float), turn, *size))
            elif geom.type == kinds.mjGEOM_FLEX and scene.flexfaceused[number]:
                first, count = int(scene.flexfaceadr[number]), int(scene.flexfaceused[number])
                if number in self._closed:
                    pieces, corners = self._solid(number).read(data), self._solid(number).corners
                else:
                    drawn, corners = slice(first, first + count), None
                    points = np.array(scene.flexface).reshape(-1, 9)[drawn].reshape(-1, 3)
                    pieces = [(points, np.array(scene.flexnormal).reshape(-1, 9)[drawn].reshape(-1, 3))]
                if material < 0:  # MuJoCo 4 keeps one for each element, and its scene names none; the first one counts
                    material = int(model.flex_matid[model.flex_elemadr[number]])
                colours = self._of_flex(number, data, corners)
                for piece, ((points, normals), own) in enumerate(zip(pieces, colours, strict=True)):
                    key, finish = ("flex", number, piece), material
                    if piece and own is not None and material >= 0 and of_material(model, material).look.clear > 0:
                        finish, rgba = -1, np.append(own.mean(axis=0), 1.0)  # foam and motes of a clear liquid
                    patches.append(Patch(key, points, normals, None, finish, rgba, FLEX - number, own))
            elif geom.type == kinds.mjGEOM_SKIN:
                first, count = int(scene.skinvertadr[number]), int(scene.skinvertnum[number])
                points, normals = (
                    np.array(values).reshape(-1, 3)[first : first + count]
                    for values in (scene.skinvert, scene.skinnormal)
                )
                skin = self._skins[number]
                normals = normals if skin.seams is None else _without_seams(normals, skin.seams)
                faces = triangles_of(model, number)
                for piece, (owner, which) in enumerate(skin.pieces):
                    at = faces[which].ravel()
                    uv = None if skin.uv is None else skin.uv[at]
                    key = ("skin", number, piece)
                    told = point_colours.of(model)
                    colours, thick = point_colours.linear(told.skin[first : first + count]), told.thick[first:][at]
                    colours = None if colours is None else colours[at]
                    deep = thick if thick.any() else None
                    patches.append(Patch(key, points[at], normals[at], uv, material, rgba, owner, colours, deep))
        return strands, patches

    def is_closed(self, flex: int) -> bool:
        """Whether a flex is drawn as what it encloses."""
        return flex in self._closed

    def is_wall(self, patch: Patch, look: Look) -> bool:
        """Whether a patch is of a closed flex of such a look that it is a thin wall around air."""
        return look.wall and patch.key[0] == "flex" and self.is_closed(patch.key[1])

    def around(self, flex: int) -> tuple[float, np.ndarray]:
        """Half the width, m, and the middle (3,), m, of a flex that is closed, as it is built: drops that fly do not count."""
        made = self._solid(flex)
        return made.half, made.middle

    def _solid(self, flex: int) -> ClosedFlex:
        """A flex that is drawn as what it encloses."""
        made = self._closed[flex]
        if made is None:
            made = self._closed[flex] = ClosedFlex(self.model, flex, at_rest(self.model, flex))
        return made

    def _of_flex(
        self, number: int, data: mujoco.MjData, corners: list[np.ndarray] | None
    ) -> Sequence[np.ndarray | None]:
        """Of each piece of a flex (3 N, 3) the colours of its corners, which are of these points, or those that the scene has; None
        where its points have none.
        """
        first, count = (int(a[number]) for a in (self.model.flex_vertadr, self.model.flex_vertnum))
        colours = point_colours.linear(point_colours.of(self.model).flex[first : first + count])
        if colours is None:
            return [None] * len(corners or (0,))
        if corners is None:
            if self._corners is None:
                self._corners = self._points_of_corners(data)
            corners = [self._corners[number] - first]
        return [np.asarray(colours[which]) for which in corners]

    def _points_of_corners(self, data: mujoco.MjData) -> list[np.ndarray]:
        """Of each flex, (3 N,) which of the model's flex points each corner of its triangles in the scene is of: asked of the
        scene with each point in a place of its own, far from the others.
        """
        import mujoco

        model, other = self.model, copy.copy(data)
        apart = 10.0 * max(1.0, float(model.flex_radius.max(initial=0.0)))
        own = np.arange(model.nflexvert)
        side = int(np.ceil(np.sqrt(model.nflexvert)))
        other.flexvert_xpos[:] = apart * np.stack([own % side, own // side, (own % side) ** 2 % 7], axis=1)
        scene = mujoco.MjvScene(model, maxgeom=20000)
        mujoco.mjv_updateScene(
            model, other, self._options, mujoco.MjvPerturb(), mujoco.MjvCamera(), mujoco.mjtCatBit.mjCAT_ALL, scene
        )
        faces = np.array(scene.flexface).reshape(-1, 9)
        found = []
        for flex in range(model.nflex):
            first, count = int(scene.flexfaceadr[flex]), int(scene.flexfaceused[flex])
            at = np.rint(faces[first : first + count].reshape(-1, 3)[:, :2] / apart).astype(int)
            found.append(at[:, 0] + side * at[:, 1])
        return found


def geom_of(model: mujoco.MjModel, body: int) -> int:
    """A geom of a body, which stands for the body in a segmentation; -1 for the world, whose skins are a film's surfaces."""
    return int(model.body_geomadr[body]) if body > 0 and model.body_geomnum[body] else -1


def held_by(model: mujoco.MjModel, skin: int) -> np.ndarray:
    """How much each of its bodies (B) holds each corner (V) of a skin: (V, B)."""
    held = np.zeros((int(model.skin_vertnum[skin]), int(model.skin_bonenum[skin])), dtype=np.float32)
    for column, bone in enumerate(range(model.skin_boneadr[skin], model.skin_boneadr[skin] + model.skin_bonenum[skin])):
        rows = slice(model.skin_bonevertadr[bone], model.skin_bonevertadr[bone] + model.skin_bonevertnum[bone])
        held[model.skin_bonevertid[rows], column] = model.skin_bonevertweight[rows]
    return held


def bodies_of(model: mujoco.MjModel, skin: int) -> np.ndarray:
    """Numbers (B,) of the bodies that a skin follows."""
    first = int(model.skin_boneadr[skin])
    return np.asarray(model.skin_bonebodyid[first : first + int(model.skin_bonenum[skin])])


def triangles_of(model: mujoco.MjModel, skin: int) -> np.ndarray:
    """(F, 3) corners of a skin's triangles."""
    first = int(model.skin_faceadr[skin])
    return np.asarray(model.skin_face[first : first + int(model.skin_facenum[skin])]).reshape(-1, 3)


def _skin(model: mujoco.MjModel, skin: int) -> _Skin:
    faces = triangles_of(model, skin)
    owner = held_by(model, skin)[faces].sum(axis=1).argmax(axis=1)
    pieces = tuple(
        (geom_of(model, int(body)), np.flatnonzero(owner == k))
        for k, body in enumerate(bodies_of(model, skin))
        if (owner == k).any()
    )
    first, count, start = (int(a[skin]) for a in (model.skin_vertadr, model.skin_vertnum, model.skin_texcoordadr))
    if start < 0:
        return _Skin(None, None, pieces)
    seams = np.unique(model.skin_vert[first : first + count], axis=0, return_inverse=True)[1].reshape(-1)
    return _Skin(np.array(model.skin_texcoord[start : start + count]).reshape(-1, 2), seams, pieces)


def _without_seams(normals: np.ndarray, seams: np.ndarray) -> np.ndarray:
    """Normals (V, 3) that go on across the edges of a picture, and not across edges of the thing."""
    whole = np.zeros((seams.max() + 1, 3))
    np.add.at(whole, seams, normals)
    whole /= np.maximum(np.linalg.norm(whole, axis=1, keepdims=True), 1e-12)
    smooth = (whole[seams] * normals).sum(axis=1, keepdims=True) > SMOOTH
    return np.where(smooth, whole[seams], normals)
