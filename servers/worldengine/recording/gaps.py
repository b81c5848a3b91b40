"""How far apart two geoms are, height fields included, and how far one may drop before it meets others.

`mj_geomDistance` has no answer for a height field: it takes the whole field for one convex solid and returns metres where
two geoms touch. There the surface is asked by rays instead, which meet the very triangles that collide: the underside of
the other geom and the field's surface, point by point, along the field's own vertical.
"""

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

RAYS = 21
"""Points along each side of the box under a geom at which it is held against a height field."""
CLOSE_M = 1e-4
"""A way down has ended when it is this near to what is below."""
STEPS = 100


def distance(model: "mujoco.MjModel", data: "mujoco.MjData", one: int, other: int, far_m: float) -> float:
    """Signed distance of two geoms, m, at most `far_m`; negative when they overlap.

    To a height field it is that to the plane of its surface where the other geom comes nearest, measured straight above
    and below it; a geom beside the field, or over none of it, is `far_m` away.
    """
    import mujoco

    field = int(mujoco.mjtGeom.mjGEOM_HFIELD)
    kinds = (int(model.geom_type[one]), int(model.geom_type[other]))
    if field not in kinds:
        return float(mujoco.mj_geomDistance(model, data, one, other, far_m, None))
    if kinds == (field, field):
        return far_m
    if kinds[0] != field:
        one, other = other, one
    gap, slope = _over(model, data, one, other)
    return min(far_m, gap * slope)


def drop(model: "mujoco.MjModel", data: "mujoco.MjData", falling: int, below: Iterable[int], most_m: float) -> float:
    """How far a geom can go straight down (world z) before it meets one of `below`, m: 0 where it touches, `most_m` if it meets none."""
    import mujoco
    import numpy as np

    start = data.geom_xpos[falling].copy()
    best = most_m
    try:
        for other in below:
            if model.geom_type[other] == mujoco.mjtGeom.mjGEOM_HFIELD:
                best = min(best, max(0.0, _over(model, data, other, falling)[0]))
                continue
            reach = model.geom_rbound[falling] + model.geom_rbound[other]
            if model.geom_rbound[other] and np.hypot(*(data.geom_xpos[other] - start)[:2]) > reach:
                continue
            way = 0.0
            for _ in range(STEPS):  # it may always go down by its distance without meeting anything
                data.geom_xpos[falling] = start - (0.0, 0.0, way)
                free = mujoco.mj_geomDistance(model, data, falling, other, most_m, None)
                if free <= CLOSE_M or way >= best:
                    break
                way += free
            best = min(best, way)
    finally:
        data.geom_xpos[falling] = start
    return best


def _over(model: "mujoco.MjModel", data: "mujoco.MjData", field: int, geom: int) -> tuple[float, float]:
    """(height of a geom over a field's surface where it is least, m; cosine of the slope there); infinite where it is beside it."""
    import mujoco
    import numpy as np

    frame, place = data.geom_xmat[field].reshape(3, 3), data.geom_xpos[field]
    turn = frame.T @ data.geom_xmat[geom].reshape(3, 3)
    centre, half = model.geom_aabb[geom].reshape(2, 3)
    middle = turn @ centre + frame.T @ (data.geom_xpos[geom] - place)
    reach = np.abs(turn) @ half
    top = float(model.hfield_size[model.geom_dataid[field], 2]) + float(reach[2]) + abs(float(middle[2])) + 1.0
    down, normal = -frame[:, 2].copy(), np.zeros(3)
    best = (float("inf"), 1.0)
    for x, y, z in _underside(model, data, geom, frame, place, middle, reach):
        above = place + frame @ (x, y, top)
        met = mujoco.mj_rayHfield(model, data, field, above, down, normal)
        if met >= 0 and z - (top - met) < best[0]:
            best = (float(z - (top - met)), float(abs(normal @ frame[:, 2])) or 1.0)
    return best


def _underside(
    model: "mujoco.MjModel",
    data: "mujoco.MjData",
    geom: int,
    frame: "np.ndarray",
    place: "np.ndarray",
    middle: "np.ndarray",
    reach: "np.ndarray",
) -> "Iterable[np.ndarray]":
    """Points of a geom's underside in a field's frame: over a grid, and the corners of what has corners."""
    import mujoco
    import numpy as np

    kind = int(model.geom_type[geom])
    mesh = kind in (int(mujoco.mjtGeom.mjGEOM_MESH), int(mujoco.mjtGeom.mjGEOM_SDF))
    turn, centre = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
    if mesh or kind == int(mujoco.mjtGeom.mjGEOM_BOX):
        if mesh:
            first, count = (int(a[model.geom_dataid[geom]]) for a in (model.mesh_vertadr, model.mesh_vertnum))
            corners = model.mesh_vert[first : first + count]
        else:
            signs = np.stack(np.meshgrid(*[(-1, 1)] * 3), axis=-1).reshape(-1, 3)
            corners = signs * model.geom_size[geom]
        yield from (corners @ turn.T + centre - place) @ frame
    up, floor = frame[:, 2].copy(), float(middle[2] - reach[2]) - 1.0
    for x in middle[0] + reach[0] * np.linspace(-1, 1, RAYS):
        for y in middle[1] + reach[1] * np.linspace(-1, 1, RAYS):
            start = place + frame @ (x, y, floor)
            if mesh:
                met = mujoco.mj_rayMesh(model, data, geom, start, up, None)
            else:
                met = mujoco.mju_rayGeom(centre, data.geom_xmat[geom], model.geom_size[geom], start, up, kind, None)
            if met >= 0:
                yield np.array((x, y, floor + met))
