"""The box around a model as it stands in its own file, by which a plan places it; measured once for all copies of it.

To measure one, all its meshes are compiled, which of a robot takes a second: of twenty-four it would take longer than the rest.
"""

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .shared_meshes import told

if TYPE_CHECKING:
    import mujoco
    import numpy as np

_KNOWN: dict[tuple[Any, ...], "Box"] = {}
"""By the text of a model and all that its meshes are made of."""


@dataclass(frozen=True)
class Box:
    """A model as it stands in its own file: the box around what is drawn or touched (planes aside), and its root's pose."""

    low: "np.ndarray"
    high: "np.ndarray"
    pos: "np.ndarray"
    quat: "np.ndarray"

    @property
    def extents(self) -> "np.ndarray":
        """(3,) m, along X, Y, Z."""
        return self.high - self.low


def of(text: str, child: "mujoco.MjSpec", again: Callable[[], "mujoco.MjSpec"], name: str) -> Box:
    """The box of a model that was parsed.

    Args:
        text: it was parsed from this.
        child: the parsed model, which stays as it is.
        again: parses it once more; what is measured is taken apart by it.
        name: of the model, for what is told.

    Raises:
        ValueError: it does not compile, has several roots, or nothing that could be seen or touched.
    """
    if child.hfields:  # whose files are not told apart here
        return _measured(again(), name)
    key = (text, *(part for mesh in child.meshes for part in (*told(mesh), _stamped(mesh.file))))
    if key not in _KNOWN:
        _KNOWN[key] = _measured(again(), name)
    return _KNOWN[key]


def _stamped(file: str) -> tuple[int, int]:
    """When a file was written, and its length; noughts without one."""
    path = Path(file)
    if not file or not path.is_file():
        return (0, 0)
    status = path.stat()
    return (status.st_mtime_ns, status.st_size)


def root(child: "mujoco.MjSpec", name: str) -> "mujoco.MjsBody":
    """Its root body; a `ValueError` where it is not the only one."""
    roots = list(child.worldbody.bodies)
    if len(roots) != 1:
        named = ", ".join(body.name or "(without a name)" for body in roots) or "none"
        raise ValueError(f"model {name}: it must have exactly one root body, it has {len(roots)}: {named}")
    roots[0].name = roots[0].name or "root"
    return roots[0]


def adopt(child: "mujoco.MjSpec", spec: "mujoco.MjSpec") -> None:
    """Give the model the world's time step, gravity and solver; the engine would warn about each that differs."""
    for key in dir(spec.option):
        if not key.startswith("_"):
            setattr(child.option, key, getattr(spec.option, key))


def put(body: "mujoco.MjsBody", rest: Box, pos: "np.ndarray", quat: "np.ndarray") -> None:
    """Pose the root so that the centre of the box is at `pos`, its parent's frame, turned by `quat`."""
    import mujoco
    import numpy as np

    away, turned = np.zeros(3), np.zeros(4)
    mujoco.mju_rotVecQuat(away, rest.pos - (rest.low + rest.high) / 2, quat)
    mujoco.mju_mulQuat(turned, quat, rest.quat)
    body.alt.type = mujoco.mjtOrientation.mjORIENTATION_QUAT
    body.pos, body.quat = pos + away, turned


def _measured(child: "mujoco.MjSpec", name: str) -> Box:
    """Of the root of a model with all that hangs on it, compiled alone."""
    import mujoco
    import numpy as np

    top = root(child, name)
    spec = mujoco.MjSpec()
    adopt(child, spec)
    before = top.name
    spec.worldbody.add_frame().attach_body(top, "model_", "")
    try:
        model = spec.compile()
    except ValueError as error:
        raise ValueError(f"model {name}: {' '.join(str(error).split())}") from error
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    low, high = np.full(3, np.inf), np.full(3, -np.inf)
    for g in range(model.ngeom):
        kind = mujoco.mjtGeom(model.geom_type[g])
        if kind == mujoco.mjtGeom.mjGEOM_PLANE:
            continue
        turn = data.geom_xmat[g].reshape(3, 3)
        if kind == mujoco.mjtGeom.mjGEOM_MESH:
            first = model.mesh_vertadr[model.geom_dataid[g]]
            cloud = (
                model.mesh_vert[first : first + model.mesh_vertnum[model.geom_dataid[g]]] @ turn.T + data.geom_xpos[g]
            )
            low, high = np.minimum(low, cloud.min(axis=0)), np.maximum(high, cloud.max(axis=0))
            continue
        # The box of a height field does not have its middle where its frame is.
        reach = _reach(kind, model.geom_size[g], turn, model.geom_aabb[g])
        middle = data.geom_xpos[g] + turn @ model.geom_aabb[g, :3]
        low, high = np.minimum(low, middle - reach), np.maximum(high, middle + reach)
    if not np.isfinite(low).all():
        raise ValueError(f"model {name}: it has no geoms, so that nobody could see or touch it")
    number = model.body(f"model_{before}").id
    return Box(low, high, model.body_pos[number].copy(), model.body_quat[number].copy())


def _reach(kind: Any, size: "np.ndarray", turn: "np.ndarray", aabb: "np.ndarray") -> "np.ndarray":
    """Half extents (3,) of the box around a primitive along the world's axes, m."""
    import mujoco
    import numpy as np

    x, y, z = size
    along = np.abs(turn[:, 2])
    if kind == mujoco.mjtGeom.mjGEOM_SPHERE:
        return np.full(3, x)
    if kind == mujoco.mjtGeom.mjGEOM_CAPSULE:
        return y * along + x
    if kind == mujoco.mjtGeom.mjGEOM_CYLINDER:
        return y * along + x * np.sqrt(np.clip(1 - along**2, 0, 1))
    if kind == mujoco.mjtGeom.mjGEOM_ELLIPSOID:
        return np.sqrt(turn**2 @ np.array((x, y, z)) ** 2)
    return np.abs(turn) @ aabb[3:]
