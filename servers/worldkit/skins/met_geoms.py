"""How far points are from a world's geoms, in closed form: plane, sphere, capsule, cylinder, box, and the way out of each.

Other shapes (mesh, ellipsoid, heightfield, pair) have no such form; a skin passes through them, so they are refused.
"""

from typing import TYPE_CHECKING

import numpy as np

from ..errors import ProgramError
from ..naming import names

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray
PLANE, SPHERE, CAPSULE, CYLINDER, BOX = 0, 2, 3, 5, 6
"""mjtGeom."""


def of_body(model: "mujoco.MjModel", body: int) -> list[int]:
    """The geoms of a body that can touch; for the world, of all that stands fast.

    Raises:
        ProgramError: one has no closed form.
    """
    found = []
    for geom in range(model.ngeom):
        owner = int(model.geom_bodyid[geom])
        own = model.body_weldid[owner] == 0 if body == 0 else owner == body
        if not own or not (model.geom_contype[geom] or model.geom_conaffinity[geom]):
            continue
        if model.geom_type[geom] not in (PLANE, SPHERE, CAPSULE, CYLINDER, BOX):
            name = names(model, "geom", model.ngeom)[geom]
            cause = f"a skin cannot tell how far it is from the geom {name!r}"
            raise ProgramError(cause, "skin", "let it touch primitives: plane, sphere, capsule, cylinder, box")
        found.append(geom)
    return found


def distance(kind: int, size: Array, p: Array) -> tuple[Array, Array]:
    """(m,) m, negative within, and (m, 3) the way out, of points (m, 3) m in the geom's own frame."""
    if kind == PLANE:
        return p[:, 2], np.broadcast_to((0.0, 0.0, 1.0), p.shape)
    if kind in (SPHERE, CAPSULE):
        axis = np.zeros_like(p)
        if kind == CAPSULE:
            axis[:, 2] = np.clip(p[:, 2], -size[1], size[1])
        away = p - axis
        far = np.linalg.norm(away, axis=1)
        return far - size[0], away / np.maximum(far, 1e-12)[:, None]
    if kind == BOX:
        return _corner(np.abs(p) - size, np.where(p < 0, -1.0, 1.0)[:, :, None] * np.eye(3))
    wide = np.maximum(np.hypot(p[:, 0], p[:, 1]), 1e-12)
    ways = np.zeros((len(p), 2, 3))
    ways[:, 0, :2] = p[:, :2] / wide[:, None]
    ways[:, 1, 2] = np.where(p[:, 2] < 0, -1.0, 1.0)
    return _corner(np.stack([wide - size[0], np.abs(p[:, 2]) - size[1]], axis=1), ways)


def _corner(over: Array, ways: Array) -> tuple[Array, Array]:
    """Of what is bounded by faces at right angles: `over` (m, a) m beyond each, whose ways out are (m, a, 3)."""
    out = np.maximum(over, 0.0)
    far = np.linalg.norm(out, axis=1)
    nearest = over.argmax(axis=1)
    share = np.where(far[:, None] > 0, out / np.maximum(far, 1e-12)[:, None], np.eye(over.shape[1])[nearest])
    return np.where(far > 0, far, over.max(axis=1)), (share[:, :, None] * ways).sum(axis=1)
