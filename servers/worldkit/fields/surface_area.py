"""The surface of a body, as it is drawn or collides: what it cools over. Sources: solid geometry; of an ellipsoid Thomsen's, within 1.1 %."""

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

THOMSEN = 1.6075
SPHERE, CAPSULE, ELLIPSOID, CYLINDER, BOX, MESH = 2, 3, 4, 5, 6, 7
"""mjtGeom."""


def of_body(model: "mujoco.MjModel", body: int) -> float:
    """m^2: the sum of its geoms; where it is drawn as meshes that do not collide, of these, since pieces have sides inside."""
    geoms = np.flatnonzero(model.geom_bodyid == body)
    solid = (model.geom_contype[geoms] | model.geom_conaffinity[geoms]) != 0
    drawn = geoms[~solid & (model.geom_type[geoms] == MESH)]
    chosen = drawn if len(drawn) else geoms[solid] if solid.any() else geoms
    return sum(of_geom(model, int(geom)) for geom in chosen)


def of_geom(model: "mujoco.MjModel", geom: int) -> float:
    """m^2: of one geom; 0 of a plane or a height field, which has no end."""
    kind, (x, y, z) = int(model.geom_type[geom]), map(float, model.geom_size[geom])
    if kind == MESH:
        mesh = int(model.geom_dataid[geom])
        first, face = model.mesh_vertadr[mesh], model.mesh_faceadr[mesh]
        a, b, c = model.mesh_vert[first + model.mesh_face[face : face + model.mesh_facenum[mesh]]].transpose(1, 0, 2)
        return float(np.linalg.norm(np.cross(b - a, c - a), axis=1).sum()) / 2
    if kind == ELLIPSOID:
        mean = ((x * y) ** THOMSEN + (x * z) ** THOMSEN + (y * z) ** THOMSEN) / 3
        return float(4 * np.pi * mean ** (1 / THOMSEN))
    known = {
        SPHERE: 4 * np.pi * x * x,
        CAPSULE: 4 * np.pi * x * (x + y),
        CYLINDER: 2 * np.pi * x * (x + 2 * y),
        BOX: 8 * (x * y + x * z + y * z),
    }
    return float(known.get(kind, 0.0))
