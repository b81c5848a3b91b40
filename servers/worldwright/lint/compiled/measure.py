"""What a compiled model is, as arrays and names: the engine's own numbers at the start, nothing judged.

Runs in the sandbox beside `probe.py`, and in tests on the rules' own cases. Arrays keep the engine's names and order;
units are the engine's: m, kg, s, rad, world frame unless said.
"""

from typing import Any

import mujoco
import numpy as np

KINDS = ("body", "joint", "geom", "site", "camera", "light", "tendon", "actuator", "equality", "flex", "key", "mesh")
COUNTS = {
    "body": "nbody",
    "joint": "njnt",
    "geom": "ngeom",
    "site": "nsite",
    "camera": "ncam",
    "light": "nlight",
    "tendon": "ntendon",
    "equality": "neq",
    "flex": "nflex",
    "key": "nkey",
    "mesh": "nmesh",
}
FIELDS = [
    "body_parentid",
    "body_treeid",
    "body_mass",
    "body_inertia",
    "body_mocapid",
    "body_jntnum",
    "body_jntadr",
    "body_dofnum",
    "body_dofadr",
    "body_geomnum",
    "body_geomadr",
    "body_gravcomp",
    "body_subtreemass",
    "body_rootid",
    "body_weldid",
    "body_contype",
    "body_conaffinity",
    "jnt_bodyid",
    "jnt_dofadr",
    "jnt_qposadr",
    "jnt_limited",
    "jnt_range",
    "jnt_stiffness",
    "jnt_pos",
    "jnt_axis",
    "dof_bodyid",
    "dof_damping",
    "dof_armature",
    "dof_frictionloss",
    "dof_invweight0",
    "dof_M0",
    "dof_jntid",
    "geom_bodyid",
    "geom_size",
    "geom_contype",
    "geom_conaffinity",
    "geom_condim",
    "geom_group",
    "geom_friction",
    "geom_solref",
    "geom_solimp",
    "geom_priority",
    "geom_margin",
    "geom_rbound",
    "geom_rgba",
    "geom_matid",
    "geom_fluid",
    "geom_surfacevel",
    "geom_dataid",
    "pair_geom1",
    "pair_geom2",
    "pair_dim",
    "pair_friction",
    "exclude_signature",
    "cam_bodyid",
    "cam_fovy",
    "cam_mode",
    "cam_targetbodyid",
    "cam_resolution",
    "cam_projection",
    "light_active",
    "light_diffuse",
    "light_ambient",
    "tendon_stiffness",
    "tendon_damping",
    "tendon_limited",
    "tendon_range",
    "tendon_invweight0",
    "tendon_lengthspring",
    "tendon_length0",
    "actuator_trntype",
    "actuator_trnid",
    "actuator_gaintype",
    "actuator_biastype",
    "actuator_gainprm",
    "actuator_biasprm",
    "actuator_gear",
    "actuator_ctrllimited",
    "actuator_ctrlrange",
    "actuator_forcelimited",
    "actuator_forcerange",
    "actuator_dyntype",
    "eq_type",
    "eq_obj1id",
    "eq_obj2id",
    "eq_objtype",
    "eq_active0",
    "eq_solref",
    "flex_dim",
    "flex_contype",
    "flex_conaffinity",
    "flex_rigid",
    "flex_stiffnessadr",
    "flex_bendingadr",
    "flex_vertnum",
    "flex_vertadr",
    "flex_edgestiffness",
    "flex_edgedamping",
    "flex_edgeequality",
    "flex_interp",
    "flex_selfcollide",
    "flex_internal",
    "flex_damping",
    "flex_vertbodyid",
    "flex_edgeadr",
    "flex_edgenum",
    "flex_edge",
    "key_qpos",
    "key_qvel",
    "mat_rgba",
    "mesh_vertnum",
    "mesh_facenum",
]
"""Fields of MjModel that are kept as they are."""
START = "start"


def facts(model: mujoco.MjModel) -> tuple[dict[str, np.ndarray], dict[str, Any]]:
    """(arrays, texts): the model's fields, its state at the start, and derived quantities there."""
    arrays = {name: np.array(getattr(model, name)) for name in FIELDS if hasattr(model, name)}
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
        "near_m": float(model.vis.map.znear * model.stat.extent),
        "counts": {"nq": model.nq, "nv": model.nv, "nu": model.nu, "nbody": model.nbody, "ngeom": model.ngeom},
        "annotated_cameras": [n for n in _names_of(model, "text", model.ntext) if n.startswith("worldkit.camera.")],
    }
    arrays["gravity"], arrays["wind"] = np.array(option.gravity), np.array(option.wind)
    light = model.vis.headlight
    arrays["headlight_colour"] = np.array([light.ambient, light.diffuse])
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
    texts["camera_inside"] = [_around(model, data, arrays["visible"], c) for c in range(model.ncam)]
    return arrays, texts


def _state(model: mujoco.MjModel, data: mujoco.MjData) -> dict[str, np.ndarray]:
    """The start: poses, velocities, contacts, residuals, effective inverse inertias."""
    from worldkit.overlaps import visible

    shown = np.asarray(visible(model), bool)
    contact = data.contact
    residual = np.zeros(model.neq)
    for row in range(data.nefc):
        if data.efc_type[row] == mujoco.mjtConstraint.mjCNSTR_EQUALITY:
            residual[data.efc_id[row]] += data.efc_pos[row] ** 2
    low, high = _extents(model, data)
    own_low, own_high = _extents(model, data, "rigid")
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
        "cam_xpos": data.cam_xpos.copy(),
        "cam_xmat": data.cam_xmat.reshape(-1, 3, 3).copy(),
        "cvel": data.cvel.copy(),
        "visible": shown,
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
    """(nbody, 3) corners of the box around a body and all it carries, in the body's own frame; NaN without geoms.

    `scope` rigid: around it and what is fixed to it, without what moves on joints against it; bare: its own geoms alone.
    """
    low, high = np.full((model.nbody, 3), np.inf), np.full((model.nbody, 3), -np.inf)
    chains = {0: [0]}
    for body in range(1, model.nbody):
        chains[body] = [*chains[int(model.body_parentid[body])], body]
    for geom in range(model.ngeom):
        if model.geom_type[geom] in (mujoco.mjtGeom.mjGEOM_PLANE, mujoco.mjtGeom.mjGEOM_HFIELD):
            continue
        points = _support(model, geom)
        frame, place = data.geom_xmat[geom].reshape(3, 3), data.geom_xpos[geom]
        for body in chains[int(model.geom_bodyid[geom])][1:]:
            if scope == "bare" and body != model.geom_bodyid[geom]:
                continue
            if scope == "rigid" and model.body_weldid[body] != model.body_weldid[model.geom_bodyid[geom]]:
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
    """Vertices of a mesh, or an empty array for a primitive."""
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
    """m^3; of a mesh the box around it, of what has no volume zero."""
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


def _around(model: mujoco.MjModel, data: mujoco.MjData, shown: np.ndarray, camera: int) -> int:
    """The visible primitive that a camera is inside of, or -1 (meshes and planes are not asked: one sees out of them)."""
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
