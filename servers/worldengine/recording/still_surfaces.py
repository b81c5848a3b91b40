"""The shapes of what stands still, as triangles in the world: what a film may stand grass and trees on, or draw anew."""

from pathlib import Path
from typing import TYPE_CHECKING

from .seen import visible

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SURFACES_FILE = "surfaces.npz"
"""Beside the streams; only where something that stands still is a height field, a mesh or a box."""


def write(model: "mujoco.MjModel", folder: Path) -> None:
    """Write `surfaces.npz`: `vertices` (V, 3) m, world frame; `faces` (F, 3); `owner` (F,) index into `names`, of bodies."""
    import mujoco
    import numpy as np

    from worldkit.naming import names

    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    bodies, shown = names(model, "body", model.nbody), visible(model)
    points, triangles, owner, count = [], [], [], 0
    for geom in np.flatnonzero(shown):
        body = int(model.geom_bodyid[geom])
        still = model.body_weldid[body] == 0 and model.body_mocapid[model.body_rootid[body]] < 0
        own = triangles_of(model, int(geom)) if still else None
        if own is None:
            continue
        vertices, faces = own
        points.append(vertices @ data.geom_xmat[geom].reshape(3, 3).T + data.geom_xpos[geom])
        triangles.append(faces + count)
        owner.append(np.full(len(faces), body))
        count += len(vertices)
    if not points:
        return
    known, index = np.unique(np.concatenate(owner), return_inverse=True)
    np.savez_compressed(
        folder / SURFACES_FILE, vertices=np.concatenate(points).astype(np.float32),
        faces=np.concatenate(triangles).astype(np.int32), owner=index.astype(np.int32),
        names=np.array([bodies[body] for body in known], dtype=str),
    )  # fmt: skip


def read(folder: Path) -> "dict[str, np.ndarray]":
    """The arrays of `surfaces.npz`; empty ones where nothing was written."""
    import numpy as np

    if not (folder / SURFACES_FILE).is_file():
        return {
            "vertices": np.zeros((0, 3), np.float32),
            "faces": np.zeros((0, 3), np.int32),
            "owner": np.zeros(0, np.int32),
            "names": np.zeros(0, dtype="U1"),
        }
    with np.load(folder / SURFACES_FILE, allow_pickle=False) as found:
        return {name: np.asarray(found[name]) for name in ("vertices", "faces", "owner", "names")}


def triangles_of(model: "mujoco.MjModel", geom: int) -> "tuple[np.ndarray, np.ndarray] | None":
    """Vertices (V, 3) in a geom's frame, m, and faces (F, 3), of a height field's top, a mesh or a box; None of any other."""
    import mujoco
    import numpy as np

    from worldkit.forms.lattice import lattice

    kind, index = mujoco.mjtGeom(int(model.geom_type[geom])), int(model.geom_dataid[geom])
    if kind == mujoco.mjtGeom.mjGEOM_MESH:
        vertex, face = (
            slice(model.mesh_vertadr[index], model.mesh_vertadr[index] + model.mesh_vertnum[index]),
            slice(model.mesh_faceadr[index], model.mesh_faceadr[index] + model.mesh_facenum[index]),
        )
        return np.asarray(model.mesh_vert[vertex], float), np.asarray(model.mesh_face[face], int)
    if kind == mujoco.mjtGeom.mjGEOM_BOX:
        corners = np.array([(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]) * model.geom_size[geom]
        quads = np.array([(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)])
        return corners, np.concatenate([quads[:, [0, 1, 2]], quads[:, [0, 2, 3]]])
    if kind != mujoco.mjtGeom.mjGEOM_HFIELD:
        return None
    rows, columns = int(model.hfield_nrow[index]), int(model.hfield_ncol[index])
    rx, ry, top, _ = model.hfield_size[index]
    start = model.hfield_adr[index]
    z = model.hfield_data[start : start + rows * columns].reshape(rows, columns) * top
    y, x = np.meshgrid(np.linspace(-ry, ry, rows), np.linspace(-rx, rx, columns), indexing="ij")
    return np.stack([x, y, z], -1).reshape(-1, 3), lattice(rows, columns)
