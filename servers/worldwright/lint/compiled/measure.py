"""Describe a compiled model in arrays and names: the engine's own numbers at the start, without a judgement.

This runs in the sandbox beside `compile_world.py`, and in tests on the rules' own cases. Arrays keep the engine's names
and order;
units are the engine's: m, kg, s, rad; the frame is the world's unless another is named.
"""

import hashlib
from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np

from worldkit import lights

KINDS = ("body", "joint", "geom", "site", "camera", "light", "tendon", "actuator", "equality", "flex", "key", "mesh")
COUNTS = {kind: f"n{kind}" for kind in KINDS} | {"joint": "njnt", "camera": "ncam", "equality": "neq"}
SEEN_ONLY = """tex_ skin_ light_ mat_ cam_ sensor_ vis stat names paths name_ text_ tuple_ numeric_"""
DERIVED = """bvh_ oct_ efm efmC mapM mapD B_ M_ D_ ten_J flexedge_J mesh_ hfield_data plugin_attr buffer signature"""
LEFT_OUT = tuple(f"{SEEN_ONLY} {DERIVED}".split())
"""Fields that begin so are left out: they only concern pictures, or follow from others, and no rule needs them."""
KEPT = [
    "cam_bodyid",
    "cam_fovy",
    "cam_mode",
    "cam_targetbodyid",
    "cam_resolution",
    "cam_projection",
    "light_active",
    "light_diffuse",
    "light_ambient",
    "light_bodyid",
    "light_type",
    "mesh_vertnum",
    "mesh_facenum",
]
START = "start"


def facts(model: mujoco.MjModel) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """(arrays, texts): the model's fields, its state at the start, and derived quantities there."""
    arrays = {name: np.array(value) for name, value in _fields(model)}
    option = model.opt
    texts: dict[str, Any] = {
        "names": {kind: _names(model, kind) for kind in KINDS},
        "geom_kind": [mujoco.mjtGeom(int(t)).name[7:].lower() for t in model.geom_type],
        "joint_kind": [mujoco.mjtJoint(int(t)).name[6:].lower() for t in model.jnt_type],
        "equality_kind": [mujoco.mjtEq(int(t)).name[5:].lower() for t in model.eq_type],
        "integrator": mujoco.mjtIntegrator(int(option.integrator)).name[6:].lower(),
        "solver": mujoco.mjtSolver(int(option.solver)).name[6:].lower(),
        "disabled": _flags(mujoco.mjtDisableBit, "mjDSBL_", option.disableflags),
        "enabled": _flags(mujoco.mjtEnableBit, "mjENBL_", option.enableflags),
        "time_step": float(option.timestep),
        "density": float(option.density),
        "viscosity": float(option.viscosity),
        "noslip_iterations": int(option.noslip_iterations),
        "headlight": bool(model.vis.headlight.active),
        "offscreen": [int(model.vis.global_.offwidth), int(model.vis.global_.offheight)],
        "option": {name: np.array(getattr(option, name)).tolist() for name in dir(option) if not name.startswith("_")},
        "mesh_sha256": [_mesh_sha256(model, mesh) for mesh in range(model.nmesh)],
        "hfield_sha256": [_hfield_sha256(model, field) for field in range(model.nhfield)],
        "near_m": float(model.vis.map.znear * model.stat.extent),
        "counts": {"nq": model.nq, "nv": model.nv, "nu": model.nu, "nbody": model.nbody, "ngeom": model.ngeom},
        "light": lights.of(model),
        "annotated_cameras": [n for n in _names_of(model, "text", model.ntext) if n.startswith("worldkit.camera.")],
    }
    arrays["bond_equality"], arrays["bond_told"], texts["bonds_wrong"] = _bonds(model)
    arrays["gravity"], arrays["wind"] = np.array(option.gravity), np.array(option.wind)
    arrays["headlight_colour"] = np.array([model.vis.headlight.ambient, model.vis.headlight.diffuse])
    data = mujoco.MjData(model)
    key = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, START)
    if key >= 0:
        mujoco.mj_resetDataKeyframe(model, data, key)
    try:
        mujoco.mj_forward(model, data)
        texts["forward"] = ""
    except Exception as error:  # what the first step of the program would meet
        texts["forward"] = str(error)[:500]
        mujoco.mj_kinematics(model, data)
    try:
        once = mujoco.MjData(model)
        mujoco.mj_copyData(once, model, data)
        mujoco.mj_step(model, once)
    except Exception as error:
        texts["forward"] = texts["forward"] or str(error)[:500]
    arrays |= _state(model, data)
    texts["camera_inside"] = [_geom_around(model, data, arrays["visible"], c) for c in range(model.ncam)]
    return arrays, texts


def _fields(model: mujoco.MjModel) -> Iterator[tuple[str, np.ndarray]]:
    """The arrays of the model that decide its motion, and the few others that rules ask for, under the engine's names."""
    for name in dir(model):
        if name in KEPT or not name.startswith(("_", *LEFT_OUT)):
            value = getattr(model, name)
            if isinstance(value, np.ndarray):
                yield name, value


def _bonds(model: mujoco.MjModel) -> tuple[np.ndarray, np.ndarray, str]:
    """(B,) which equalities are bonds, (B, 15) what decides their stress, whether they break and with what, and what makes it unreadable.

    A row: the nine axes, the area, m^2, three moduli, m^3, the strength, Pa, and 1 for a hold.
    """
    from worldkit.breaking.letting_go import bonds_of
    from worldkit.errors import ProgramError

    try:
        bonds, wrong = bonds_of(model), ""
    except ProgramError as error:
        bonds, wrong = None, str(error)
    if bonds is None:
        return np.zeros(0, int), np.zeros((0, 15)), wrong
    hold = bonds.pieces[:, 0] == bonds.pieces[:, 1]
    told = (bonds.axes.reshape(-1, 9), bonds.area, bonds.moduli, bonds.strength, hold)
    return bonds.equality, np.column_stack(told), wrong


def _mesh_sha256(model: mujoco.MjModel, mesh: int) -> str:
    """Hash the vertices with which a mesh collides, rounded to a tenth of a micron, whatever file they came from."""
    first, count = int(model.mesh_vertadr[mesh]), int(model.mesh_vertnum[mesh])
    return hashlib.sha256(np.round(model.mesh_vert[first : first + count] * 1e7).astype(np.int64).tobytes()).hexdigest()


def _hfield_sha256(model: mujoco.MjModel, field: int) -> str:
    """Hash a height field's grid, its extents and its heights, these rounded to a tenth of a millimetre."""
    grid, first, size = (
        (model.hfield_nrow[field], model.hfield_ncol[field]),
        model.hfield_adr[field],
        model.hfield_size[field],
    )
    heights = model.hfield_data[first : first + grid[0] * grid[1]] * size[2]
    return hashlib.sha256(
        np.round(np.concatenate([grid, size * 1e4, heights * 1e4])).astype(np.int64).tobytes()
    ).hexdigest()


def _state(model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, np.ndarray]:
    """The start: poses, velocities, contacts, residuals, effective inverse inertias."""
    from worldengine import read_by_solvers
    from worldengine.recording.seen import geom_rgba, skinned, visible

    shown = np.asarray(visible(model), bool)
    contact = data.contact
    residual = np.zeros(model.neq)
    for row in range(data.nefc):
        if data.efc_type[row] == mujoco.mjtConstraint.mjCNSTR_EQUALITY:
            residual[data.efc_id[row]] += data.efc_pos[row] ** 2
    low, high = _extents(model, data)
    own_low, own_high = _extents(model, data, "rigid")
    touch_low, touch_high = _extents(model, data, "touched")
    bare_low, bare_high = _extents(model, data, "bare")
    home = mujoco.MjData(model)  # where it was built, before a joint's initial position moves it
    mujoco.mj_kinematics(model, home)
    return {
        "home_xpos": home.xpos.copy(),
        "home_xmat": home.xmat.reshape(-1, 3, 3).copy(),
        "qpos": data.qpos.copy(),
        "qvel": data.qvel.copy(),
        "xpos": data.xpos.copy(),
        "xmat": data.xmat.reshape(-1, 3, 3).copy(),
        "geom_xpos": data.geom_xpos.copy(),
        "geom_xmat": data.geom_xmat.reshape(-1, 3, 3).copy(),
        "light_xpos": data.light_xpos.copy(),
        "cam_xpos": data.cam_xpos.copy(),
        "cam_xmat": data.cam_xmat.reshape(-1, 3, 3).copy(),
        "cvel": data.cvel.copy(),
        "visible": shown,
        "geom_alpha": geom_rgba(model)[:, 3],
        "skinned": skinned(model),
        "contact_geom": np.array(contact.geom).reshape(-1, 2),
        "contact_depth": -np.array(contact.dist).reshape(-1),
        "near_geom": _near(model, data),
        "equality_residual": np.sqrt(residual),
        "body_low": low,
        "body_high": high,
        "own_low": own_low,
        "own_high": own_high,
        "bare_low": bare_low,
        "bare_high": bare_high,
        **read_by_solvers.told(model),
        "geom_solid": np.array([_solid(model, g) for g in range(model.ngeom)]),
        "geom_middle": np.array([_spread(model, g)[0] for g in range(model.ngeom)]).reshape(-1, 3),
        "geom_spread": np.array([_spread(model, g)[1] for g in range(model.ngeom)]).reshape(-1, 3, 3),
        "touch_low": touch_low,
        "touch_high": touch_high,
        "geom_volume": np.array([_volume(model, g) for g in range(model.ngeom)]),
        "actuator_invweight": _actuator_invweight(model, data),
    }


def _near(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """(pairs, 2) geoms that touch at the start, or would within 2 mm."""
    margins = (model.geom_margin.copy(), model.body_margin.copy())
    once = mujoco.MjData(model)
    once.qpos[:], once.mocap_pos[:], once.mocap_quat[:] = data.qpos, data.mocap_pos, data.mocap_quat
    try:
        model.geom_margin[:] += 2e-3
        model.body_margin[:] += 2e-3
        mujoco.mj_fwdPosition(model, once)
        return np.array(once.contact.geom).reshape(-1, 2).copy()
    except Exception:  # what cannot be collided is reported by the first step
        return np.zeros((0, 2), int)
    finally:
        model.geom_margin[:], model.body_margin[:] = margins


def _actuator_invweight(model: mujoco.MjModel, data: mujoco.MjData) -> np.ndarray:
    """(outputs,) acceleration along each actuator's transmission per unit force, 1/kg or 1/(kg m^2)."""
    rows = len(data.moment_rowadr) if model.nu else 0
    found = np.zeros(rows)
    for a in range(rows):
        start, count = data.moment_rowadr[a], data.moment_rownnz[a]
        jacobian = np.zeros((1, model.nv))
        jacobian[0, data.moment_colind[start : start + count]] = data.actuator_moment[start : start + count]
        solved = np.zeros((1, model.nv))
        mujoco.mj_solveM(model, data, solved, jacobian)
        found[a] = float(jacobian[0] @ solved[0])
    return found


def _extents(model: mujoco.MjModel, data: mujoco.MjData, scope: str = "all") -> tuple[np.ndarray, np.ndarray]:
    """(nbody, 3) each, m: the corners of the box around a body and all it carries, in the body's frame; NaN without geoms.

    With `scope` rigid, the box leaves out what moves on joints against the body; with touched, also geoms that never
    collide; with bare, it holds the body's own geoms alone.
    """
    low, high = np.full((model.nbody, 3), np.inf), np.full((model.nbody, 3), -np.inf)
    chains = {0: [0]}
    for body in range(1, model.nbody):
        chains[body] = [*chains[int(model.body_parentid[body])], body]
    for geom in range(model.ngeom):
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_PLANE:
            continue
        points = _support(model, geom)
        frame, place = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
        if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_HFIELD:  # its box does not have its middle where its frame is
            place = place + frame @ model.geom_aabb[geom, :3]
        for body in chains[int(model.geom_bodyid[geom])][1:]:
            if scope == "bare" and body != model.geom_bodyid[geom]:
                continue
            if scope == "touched" and not (model.geom_contype[geom] | model.geom_conaffinity[geom]):
                continue
            if scope in ("rigid", "touched") and model.body_weldid[body] != model.body_weldid[model.geom_bodyid[geom]]:
                continue
            turn = data.xmat[body].reshape(3, 3).T
            centre, axes = turn @ (place - data.xpos[body]), turn @ frame
            if points.ndim == 2:  # vertices
                corners = points @ axes.T + centre
                least, most = corners.min(axis=0), corners.max(axis=0)
            else:
                reach = _reach(model, geom, axes)
                least, most = centre - reach, centre + reach
            low[body], high[body] = np.minimum(low[body], least), np.maximum(high[body], most)
    empty = ~np.isfinite(low)
    low[empty], high[empty] = np.nan, np.nan
    return low, high


def _support(model: mujoco.MjModel, geom: int) -> np.ndarray:
    """(n, 3) vertices of a mesh, m; none for a primitive."""
    mesh = int(model.geom_dataid[geom])
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and mesh >= 0:
        first = int(model.mesh_vertadr[mesh])
        return np.array(model.mesh_vert[first : first + int(model.mesh_vertnum[mesh])], float)
    return np.zeros(0)


def _reach(model: mujoco.MjModel, geom: int, axes: np.ndarray) -> np.ndarray:
    """(3,) half extents of a primitive along the axes of the frame that `axes` turns it into."""
    size, kind = model.geom_size[geom], mujoco.mjtGeom(int(model.geom_type[geom])).name
    if kind == "mjGEOM_SPHERE":
        return np.full(3, size[0])
    if kind == "mjGEOM_CAPSULE":
        return size[0] + np.abs(axes[:, 2]) * size[1]
    if kind == "mjGEOM_CYLINDER":
        return size[0] * np.sqrt(np.maximum(0.0, 1.0 - axes[:, 2] ** 2)) + np.abs(axes[:, 2]) * size[1]
    if kind == "mjGEOM_ELLIPSOID":
        return np.sqrt(((axes * size) ** 2).sum(axis=1))
    half = model.geom_aabb[geom, 3:] if kind != "mjGEOM_BOX" else size
    return np.abs(axes) @ half


def _volume(model: mujoco.MjModel, geom: int) -> float:
    """The volume of a geom, m^3: for a mesh that of the box around it, for a plane zero."""
    a, b, c = model.geom_size[geom]
    kind = mujoco.mjtGeom(int(model.geom_type[geom])).name
    ball = 4.0 / 3.0 * np.pi
    known = {
        "mjGEOM_SPHERE": ball * a**3,
        "mjGEOM_BOX": 8 * a * b * c,
        "mjGEOM_ELLIPSOID": ball * a * b * c,
        "mjGEOM_CYLINDER": 2 * np.pi * a * a * b,
        "mjGEOM_CAPSULE": ball * a**3 + 2 * np.pi * a * a * b,
        "mjGEOM_MESH": float(8 * np.prod(model.geom_aabb[geom, 3:])),
    }
    return float(known.get(kind, 0.0))


def _solid(model: mujoco.MjModel, geom: int) -> float:
    """The volume of a geom as it collides, m^3: for a mesh that of its convex hull, else as `_volume`."""
    if model.geom_type[geom] != mujoco.mjtGeom.mjGEOM_MESH or model.geom_dataid[geom] < 0:
        return _volume(model, geom)
    corners = _hull(model, int(model.geom_dataid[geom]))
    return float(abs(np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2])).sum()) / 6)


def _spread(model: mujoco.MjModel, geom: int) -> tuple[np.ndarray, np.ndarray]:
    """Middle (3,), m, and covariance (3, 3), m^2, of the points inside a geom as it collides, in its frame; nil for a plane."""
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH and model.geom_dataid[geom] >= 0:
        corners = _hull(model, int(model.geom_dataid[geom]))  # tetrahedra from the origin to each face
        volumes = np.einsum("ij,ij->i", corners[:, 0], np.cross(corners[:, 1], corners[:, 2]))
        if abs(volumes.sum()) < 1e-18:
            return np.zeros(3), np.zeros((3, 3))
        share, sums = volumes / volumes.sum(), corners.sum(axis=1)
        middle = share @ sums / 4
        square = np.einsum("n,nki,nkj->ij", share, corners, corners) + np.einsum("n,ni,nj->ij", share, sums, sums)
        return middle, square / 20 - np.outer(middle, middle)
    (a, b, c), kind = model.geom_size[geom], mujoco.mjtGeom(int(model.geom_type[geom])).name
    ball, rod = 4 / 3 * a**3, 2 * a * a * b
    square = {
        "mjGEOM_SPHERE": (a * a / 5,) * 3,
        "mjGEOM_BOX": (a * a / 3, b * b / 3, c * c / 3),
        "mjGEOM_ELLIPSOID": (a * a / 5, b * b / 5, c * c / 5),
        "mjGEOM_CYLINDER": (a * a / 4, a * a / 4, b * b / 3),
        "mjGEOM_CAPSULE": (
            *((rod / 4 + ball / 5) * a * a / (rod + ball or 1.0),) * 2,
            (rod * b * b / 3 + ball * (b * b + 0.75 * a * b + a * a / 5)) / (rod + ball or 1.0),
        ),
    }
    return np.zeros(3), np.diag(square.get(kind, (0.0, 0.0, 0.0)))


def _hull(model: mujoco.MjModel, mesh: int) -> np.ndarray:
    """(faces, 3, 3) the corners of the convex hull with which a mesh collides, m, in the mesh's frame."""
    first, graph = int(model.mesh_vertadr[mesh]), int(model.mesh_graphadr[mesh])
    if graph >= 0:  # vertices, faces, then three rows of addresses and edges, then the hull's faces by vertex
        vertices, count = (int(n) for n in model.mesh_graph[graph : graph + 2])
        start = graph + 2 + 3 * vertices + 3 * count
        faces = model.mesh_graph[start : start + 3 * count].reshape(-1, 3)
    else:
        face = int(model.mesh_faceadr[mesh])
        faces = model.mesh_face[face : face + int(model.mesh_facenum[mesh])]
    return np.asarray(model.mesh_vert[first + faces], float)


def _geom_around(model: mujoco.MjModel, data: mujoco.MjData, shown: np.ndarray, camera: int) -> int:
    """The visible primitive in which a camera stands, or -1; meshes and planes do not count, as one sees out of them."""
    for geom in np.flatnonzero(shown):
        if int(model.geom_bodyid[geom]) == int(model.cam_bodyid[camera]) != 0:
            continue  # a camera in a robot's eye
        point = data.geom_xmat[geom].reshape(3, 3).T @ (data.cam_xpos[camera] - data.geom_xpos[geom])
        size, kind = model.geom_size[geom], mujoco.mjtGeom(int(model.geom_type[geom])).name
        if _contains(kind, size, point):
            return int(geom)
    return -1


def _contains(kind: str, size: np.ndarray, point: np.ndarray) -> bool:
    if kind == "mjGEOM_SPHERE":
        return bool(np.linalg.norm(point) < size[0])
    if kind == "mjGEOM_BOX":
        return bool((np.abs(point) < size).all())
    if kind == "mjGEOM_ELLIPSOID":
        return bool(((point / size) ** 2).sum() < 1.0)
    if kind == "mjGEOM_CYLINDER":
        return bool(np.hypot(point[0], point[1]) < size[0] and abs(point[2]) < size[1])
    if kind == "mjGEOM_CAPSULE":
        along = np.clip(point[2], -size[1], size[1])
        return bool(np.linalg.norm(point - [0, 0, along]) < size[0])
    return False


def _names(model: mujoco.MjModel, kind: str) -> list[str]:
    count = len(model.actuator_trntype) if kind == "actuator" else int(getattr(model, COUNTS[kind]))
    return _names_of(model, kind, count)


def _names_of(model: mujoco.MjModel, kind: str, count: int) -> list[str]:
    code = getattr(mujoco.mjtObj, f"mjOBJ_{kind.upper()}")
    return [mujoco.mj_id2name(model, code, i) or "" for i in range(count)]


def _flags(enum: Any, prefix: str, bits: int) -> list[str]:
    found = enum.__members__.items()
    return [n.removeprefix(prefix).lower() for n, bit in found if n.startswith(prefix) and bits & bit.value]
