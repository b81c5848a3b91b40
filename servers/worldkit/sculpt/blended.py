"""One skin over several bodies, bent where they bend: each corner follows the bodies next to it, by how near they are.

Source: N. Magnenat-Thalmann et al., "Joint-dependent local deformations" (1988): linear blending; MuJoCo manual, XML reference,
`deformable/skin`.
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ..naming import free
from .minting import Made
from .primitives import box, capsule, cylinder, ellipsoid, sphere
from .signed import Array

if TYPE_CHECKING:
    import mujoco

LEAST = 1e-3
"""A weight below this is none."""


def bind(spec: "mujoco.MjSpec", names: Sequence[str], solid: Made, pos: Array, blend: float | None, look: str) -> str:
    """Add the skin of a made shape over bodies that are there; returns its name.

    Args:
        spec: the world under construction.
        names: of the bodies, the first of which is the one that `pos` is measured from.
        solid: what is drawn.
        pos: (3,) m, where the centre of the box around it lies in the first body's frame, as the world is built.
        blend: length, m, over which it flows from one body to the next; None: a third of its middle extent.
        look: name of a material of the world.

    Raises:
        ValueError: a body has nothing that a corner could be near to.
    """
    import mujoco

    copy = spec.copy()
    model = copy.compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    ids = [model.body(name).id for name in names]
    turn = data.xmat[ids[0]].reshape(3, 3)
    middle = (solid.low + solid.high) / 2
    points = data.xpos[ids[0]] + (solid.vertices - middle + pos) @ turn.T
    length = float(np.sort(solid.high - solid.low)[1]) / 3 if blend is None else blend
    if not 0 < length < np.inf:
        raise ValueError(f"dress: blend must be a positive length in metres, not {blend}")
    weights = shares(model, data, ids, points, length)
    name = free(f"{names[0]}/skin", {skin.name for skin in spec.skins})
    skin = spec.add_skin(name=name, material=look)
    skin.vert, skin.face = points.ravel(), solid.faces.ravel().astype(np.int32)
    if len(solid.uv):
        skin.texcoord = solid.uv.ravel()
    skin.bodyname = list(names)
    skin.bindpos, skin.bindquat = data.xpos[ids].ravel(), data.xquat[ids].ravel()
    listed = [np.flatnonzero(weights[:, k] > 0) for k in range(len(ids))]
    skin.vertid = [found.astype(np.int32).tolist() for found in listed]
    skin.vertweight = [weights[found, k].tolist() for k, found in enumerate(listed)]
    return name


def shares(model: "mujoco.MjModel", data: "mujoco.MjData", ids: Sequence[int], points: Array, length: float) -> Array:
    """How much each of some bodies (B) holds each of some points (N, 3): (N, B), rows that sum to one.

    A point follows the body it is nearest to, and of the others those that hang on that one or that it hangs on.
    """
    away = np.column_stack([_distances(model, data, body, points) for body in ids])
    nearest = away.argmin(axis=1)
    beside = np.array([[_beside(model, a, b, ids) for b in ids] for a in ids])
    fall = np.clip(1 - (away - away.min(axis=1, keepdims=True)) / length, 0, 1)
    found = np.where(beside[nearest], fall * fall * (3 - 2 * fall), 0.0)
    found[found < LEAST] = 0.0
    return np.asarray(found / found.sum(axis=1, keepdims=True))


def _beside(model: "mujoco.MjModel", a: int, b: int, ids: Sequence[int]) -> bool:
    """Whether one body hangs on the other, whatever lies between that is not of these."""

    def above(body: int) -> int:
        body = int(model.body_parentid[body])
        while body > 0 and body not in ids:
            body = int(model.body_parentid[body])
        return body

    return a == b or above(a) == b or above(b) == a


def _distances(model: "mujoco.MjModel", data: "mujoco.MjData", body: int, points: Array) -> Array:
    """Of points (N, 3) from the nearest shape of a body, m, negative inside."""
    import mujoco

    kinds = mujoco.mjtGeom
    found = []
    for geom in np.flatnonzero(model.geom_bodyid == body):
        local = (points - data.geom_xpos[geom]) @ data.geom_xmat[geom].reshape(3, 3)
        x, y, z = (float(v) for v in model.geom_size[geom])
        shape: Any = None
        kind = kinds(int(model.geom_type[geom]))
        if kind == kinds.mjGEOM_CAPSULE:
            shape = capsule((0, 0, -y), (0, 0, y), 2 * x)
        elif kind == kinds.mjGEOM_CYLINDER:
            shape = cylinder(2 * x, 2 * y)
        elif kind == kinds.mjGEOM_ELLIPSOID:
            shape = ellipsoid((2 * x, 2 * y, 2 * z))
        elif kind == kinds.mjGEOM_SPHERE:
            shape = sphere(2 * x)
        elif kind in (kinds.mjGEOM_BOX, kinds.mjGEOM_MESH):
            local = local - model.geom_aabb[geom, :3]
            wide, deep, high = (2 * float(v) for v in model.geom_aabb[geom, 3:])
            shape = box((wide, deep, high))
        if shape is not None:
            found.append(shape(local))
    if not found:
        raise ValueError(f"dress: the body {model.body(body).name} has no shape that a skin could follow")
    return np.asarray(np.min(found, axis=0))
