"""How far a body reaches, as a hand that is to hold it needs to know, and where something can be put down on it."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np


LEVEL = 0.999
"""Cosine of the most that a face may lean on which something is put."""


def outline(model: "mujoco.MjModel", data: "mujoco.MjData", body: str) -> "np.ndarray":
    """(P, 3) points that a body and all that hangs on it do not reach beyond, m: of what touches, the vertices of meshes and the
    corners of boxes around all else."""
    import numpy as np

    found = [corners(model, data, geom) for geom in touching(model, body)]
    return np.concatenate(found) if found else data.body(body).xpos[None]


def touching(model: "mujoco.MjModel", body: str) -> list[int]:
    """The geoms of a body, and of all that hangs on it, which touch something."""
    root, own = model.body(body).id, set[int]()
    for number in range(root, model.nbody):
        if number == root or int(model.body_parentid[number]) in own:
            own.add(number)
    touches = (model.geom_contype | model.geom_conaffinity).astype(bool)
    return [geom for geom in range(model.ngeom) if int(model.geom_bodyid[geom]) in own and touches[geom]]


def corners(model: "mujoco.MjModel", data: "mujoco.MjData", geom: int) -> "np.ndarray":
    """(P, 3) of one geom, m."""
    import mujoco
    import numpy as np

    turn, at = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    if mujoco.mjtGeom(model.geom_type[geom]) == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        first = model.mesh_vertadr[mesh]
        own = model.mesh_vert[first : first + model.mesh_vertnum[mesh]]
    else:
        signs = np.stack(np.meshgrid(*[(-1, 1)] * 3), axis=-1).reshape(-1, 3)
        own = model.geom_aabb[geom, :3] + signs * model.geom_aabb[geom, 3:]
    return own @ turn.T + at


def boards(model: "mujoco.MjModel", data: "mujoco.MjData", body: str, across: float) -> "list[np.ndarray]":
    """The middles (3,) of the level upper faces of a body's geoms that are at least so wide both ways, m, from the lowest up; the
    face of a mesh is that of its box."""
    import mujoco
    import numpy as np

    flat = (mujoco.mjtGeom.mjGEOM_BOX, mujoco.mjtGeom.mjGEOM_CYLINDER, mujoco.mjtGeom.mjGEOM_MESH)
    found = []
    for geom in touching(model, body):
        turn, size = data.geom_xmat[geom].reshape(3, 3), model.geom_aabb[geom, 3:]
        upright = int(np.argmax(np.abs(turn[2])))
        if mujoco.mjtGeom(model.geom_type[geom]) not in flat or abs(turn[2, upright]) < LEVEL:
            continue
        if upright != 2 and mujoco.mjtGeom(model.geom_type[geom]) == mujoco.mjtGeom.mjGEOM_CYLINDER:
            continue  # it lies on its side
        if 2 * min(np.delete(size, upright)) >= across:
            middle = data.geom_xpos[geom] + turn @ model.geom_aabb[geom, :3]
            found.append(middle + np.array((0, 0, size[upright])))
    return sorted(found, key=lambda middle: float(middle[2]))
