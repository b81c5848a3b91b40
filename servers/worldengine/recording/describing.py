"""Describe a model in words and numbers, as a recording's `meta.json` tells about its world."""

import hashlib
from typing import TYPE_CHECKING, Any

from worldkit.naming import names

from . import ties
from .seen import visible, visible_skins

if TYPE_CHECKING:
    import mujoco


def fingerprint(model: "mujoco.MjModel") -> str:
    """SHA-256 of the compiled model: every array, option and name."""
    import mujoco
    import numpy as np

    buffer = np.empty(mujoco.mj_sizeModel(model), np.uint8)
    mujoco.mj_saveModel(model, None, buffer)
    return hashlib.sha256(buffer.data).hexdigest()


def describe(model: "mujoco.MjModel", visual_only: tuple[str, ...] = ()) -> dict[str, Any]:
    """The part of `meta.json` that depends on the model alone.

    Args:
        model: the compiled world.
        visual_only: bodies declared to be drawn but not simulated.
    """
    import mujoco

    home = mujoco.MjData(model)
    mujoco.mj_kinematics(model, home)  # anchors are read in the reference pose
    bodies = names(model, "body", model.nbody)
    pulled = pulled_bodies(model)
    joint_types = [mujoco.mjtJoint(t).name.removeprefix("mjJNT_").lower() for t in model.jnt_type]
    options = model.opt
    shown, collides = visible(model), (model.geom_contype != 0) | (model.geom_conaffinity != 0)
    collides[model.pair_geom1] = collides[model.pair_geom2] = True
    return {
        "simulator": {"name": "mujoco", "version": mujoco.__version__},
        "model": {"name": _model_name(model), "fingerprint": fingerprint(model)},
        "time_step": float(options.timestep),
        "gravity": [float(g) for g in options.gravity],
        "integrator": mujoco.mjtIntegrator(options.integrator).name.removeprefix("mjINT_").lower(),
        "cone": mujoco.mjtCone(options.cone).name.removeprefix("mjCONE_").lower(),
        "flags": {
            "disabled": _flags(mujoco.mjtDisableBit, "mjDSBL_", options.disableflags),
            "enabled": _flags(mujoco.mjtEnableBit, "mjENBL_", options.enableflags),
        },
        "sizes": {
            k: int(getattr(model, k))
            for k in ("nq", "nv", "na", "nu", "nmocap", "neq", "ntendon", "nsensordata", "nplastic")
        },
        "option": {
            "density": float(options.density),
            "viscosity": float(options.viscosity),
            "wind": options.wind.tolist(),
        },
        "has_flex": bool(model.nflex),
        "has_plugin": bool(model.nplugin),
        "bodies": [_body(model, b, bodies, joint_types, visual_only) for b in range(1, model.nbody)],
        "joints": [
            {
                "name": name,
                "type": joint_types[j],
                "body": bodies[model.jnt_bodyid[j]],
                "qpos_address": int(model.jnt_qposadr[j]),
                "dof_address": int(model.jnt_dofadr[j]),
                "stiffness": float(model.jnt_stiffness[j]),
                "damping": float(model.dof_damping[model.jnt_dofadr[j]]),
                "frictionloss": float(model.dof_frictionloss[model.jnt_dofadr[j]]),
                **ties.joint(model, j),
            }
            for j, name in enumerate(names(model, "joint", model.njnt))
        ],
        "geoms": [
            {**_geom(model, g, name, bodies), "visible": bool(shown[g]), "collides": bool(collides[g])}
            for g, name in enumerate(names(model, "geom", model.ngeom))
        ],
        "tendons": [
            {
                "name": name,
                "bodies": pulled["tendon"][t],
                "limited": bool(model.tendon_limited[t]),
                **ties.rope(model, t, bodies),
            }
            for t, name in enumerate(names(model, "tendon", model.ntendon))
        ],
        "actuators": [
            {"name": name, "bodies": bodies}
            for name, bodies in zip(actuator_columns(model)[1], pulled["actuator"], strict=True)
        ],
        "sensors": [
            {
                "name": name,
                "type": mujoco.mjtSensor(model.sensor_type[s]).name.removeprefix("mjSENS_").lower(),
                "address": int(model.sensor_adr[s]),
                "dim": int(model.sensor_dim[s]),
            }
            for s, name in enumerate(names(model, "sensor", model.nsensor))
        ],
        "flexes": [_flex(model, f, name, bodies) for f, name in enumerate(names(model, "flex", model.nflex))],
        "skins": [
            {"name": name, "bodies": _followed(model, s, bodies), "visible": bool(drawn)}
            for s, (name, drawn) in enumerate(zip(names(model, "skin", model.nskin), visible_skins(model), strict=True))
        ],
        "excludes": [[bodies[int(s) >> 16], bodies[int(s) & 0xFFFF]] for s in model.exclude_signature],
        "cameras": names(model, "camera", model.ncam),
        "equalities": [
            {
                "name": name,
                "type": mujoco.mjtEq(model.eq_type[e]).name.removeprefix("mjEQ_").lower(),
                "bodies": tied_bodies(model, e, bodies),
                "active": bool(model.eq_active0[e]),
                **ties.tie(model, home, e, bodies),
            }
            for e, name in enumerate(names(model, "equality", model.neq))
        ],
    }


def _body(
    model: "mujoco.MjModel", b: int, bodies: list[str], joint_types: list[str], visual_only: tuple[str, ...]
) -> dict[str, Any]:
    """One body; `ipos` and `iquat` place its centre of mass and principal axes in its own frame."""
    joints, first = int(model.body_jntnum[b]), int(model.body_jntadr[b])
    dofs = slice(model.body_dofadr[b], model.body_dofadr[b] + model.body_dofnum[b])
    return {
        "name": bodies[b],
        "parent": bodies[model.body_parentid[b]],
        "mass": float(model.body_mass[b]),
        "ipos": model.body_ipos[b].tolist(),
        "iquat": model.body_iquat[b].tolist(),
        "inertia": model.body_inertia[b].tolist(),
        "joints": joint_types[first : first + joints] if joints else [],
        "damping": float(abs(model.dof_damping[dofs]).max(initial=0.0)) if joints else 0.0,
        "gravcomp": float(model.body_gravcomp[b]),
        "dynamic": bool(model.body_treeid[b] >= 0),
        "mocap": bool(model.body_mocapid[b] >= 0),
        "visual_only": bodies[b] in visual_only,
    }


def _geom(model: "mujoco.MjModel", g: int, name: str, bodies: list[str]) -> dict[str, Any]:
    """One geom; `aabb` is (centre, half extents) in its own frame, which `pos` and `quat` place in its body's."""
    import mujoco

    return {
        "name": name,
        "body": bodies[model.geom_bodyid[g]],
        "type": mujoco.mjtGeom(model.geom_type[g]).name.removeprefix("mjGEOM_").lower(),
        "size": model.geom_size[g].tolist(),
        "aabb": model.geom_aabb[g].ravel().tolist(),
        "pos": model.geom_pos[g].tolist(),
        "quat": model.geom_quat[g].tolist(),
        "contype": int(model.geom_contype[g]),
        "conaffinity": int(model.geom_conaffinity[g]),
        "group": int(model.geom_group[g]),
        "friction": model.geom_friction[g].tolist(),
        "condim": int(model.geom_condim[g]),
        "surfacevel": bool(model.geom_surfacevel[g].any()),
        "adhesion": bool(model.geom_adhesion[g].any()),
        **({"surface": model.geom_surfacevel[g].ravel().tolist()} if model.geom_surfacevel[g].any() else {}),
        **({"adhesion_n": float(model.geom_adhesion[g].max())} if model.geom_adhesion[g].any() else {}),
    }


def _followed(model: "mujoco.MjModel", s: int, bodies: list[str]) -> list[str]:
    """The bodies that a skin follows."""
    first = int(model.skin_boneadr[s])
    return [bodies[b] for b in model.skin_bonebodyid[first : first + int(model.skin_bonenum[s])]]


def _flex(model: "mujoco.MjModel", f: int, name: str, bodies: list[str]) -> dict[str, Any]:
    """One flex: the number of its vertices, the bodies that carry its shape, the static bodies that hold vertices."""
    first = int(model.flex_vertadr[f])
    owners = model.flex_vertbodyid[first : first + int(model.flex_vertnum[f])]
    node = int(model.flex_nodeadr[f])
    nodes = model.flex_nodebodyid[node : node + int(model.flex_nodenum[f])] if node >= 0 else ()
    held = [int(b) for b in owners if b >= 0 and model.body_treeid[b] < 0 and model.body_mocapid[b] < 0]
    return {
        "name": name,
        "vertices": len(owners),
        # An interpolated flex has its shape from a few nodes, and its vertices belong to no body.
        "bodies": list(dict.fromkeys(bodies[int(b)] for b in (*nodes, *owners) if b > 0)),
        "pinned": len(held),
        "pinned_to": sorted({bodies[b] for b in held}),
        **_skin(model, f, bodies),
    }


def _skin(model: "mujoco.MjModel", f: int, bodies: list[str]) -> dict[str, Any]:
    """The closed surface of a solid flex: `shell`, triples of vertices, outwards; and what the vertices follow.

    That is `owners`, the body of each vertex; or, of a flex that a lattice of bodies carries, `lattice`: how many `cells` it
    has along x, y, z, its `nodes` (bodies, z fastest) and the place of each vertex `at`, 0 to 1 across the whole lattice. Of a
    surface that no body carries, for a law moves it, `faces`: triples of vertices.
    """
    if model.flex_dim[f] == 2 and not model.flex_interp[f]:
        first, count = int(model.flex_vertadr[f]), int(model.flex_vertnum[f])
        if not model.flex_vertbodyid[first : first + count].any():
            start, triangles = int(model.flex_elemdataadr[f]), int(model.flex_elemnum[f])
            return {"faces": model.flex_elem[start : start + 3 * triangles].tolist()}
    if model.flex_dim[f] != 3 or model.flex_interp[f] > 1:  # a quadratic cell has nodes between its corners
        return {}
    first, count = int(model.flex_vertadr[f]), int(model.flex_vertnum[f])
    start, triangles = int(model.flex_shelldataadr[f]), int(model.flex_shellnum[f])
    shell = {"shell": model.flex_shell[start : start + 3 * triangles].tolist()}
    if not model.flex_interp[f]:
        return {**shell, "owners": [bodies[b] for b in model.flex_vertbodyid[first : first + count]]}
    node, nodes = int(model.flex_nodeadr[f]), int(model.flex_nodenum[f])
    lattice = {
        "cells": model.flex_cellnum[f].tolist(),
        "nodes": [bodies[b] for b in model.flex_nodebodyid[node : node + nodes]],
        "at": model.flex_vert0[first : first + count].tolist(),
    }
    return {**shell, "lattice": lattice}


def tied_bodies(model: "mujoco.MjModel", e: int, bodies: list[str]) -> list[str]:
    """The bodies that an equality ties together (its sites', joints' bodies); empty for tendons and flexes."""
    import mujoco

    kind, ends = mujoco.mjtEq(model.eq_type[e]), (int(model.eq_obj1id[e]), int(model.eq_obj2id[e]))
    if kind in (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD):
        site = model.eq_objtype[e] == mujoco.mjtObj.mjOBJ_SITE
        return [bodies[model.site_bodyid[i] if site else i] for i in ends if i >= 0]
    if kind == mujoco.mjtEq.mjEQ_JOINT:
        return [bodies[model.jnt_bodyid[i]] for i in ends if i >= 0]
    return []


def actuator_columns(model: "mujoco.MjModel") -> tuple[list[str], list[str]]:
    """Names of the controls, and of the force outputs: the actuator's, with a number where it has several of them."""

    def columns(count: Any) -> list[str]:
        called = names(model, "actuator", len(count))
        return [
            name if n == 1 else f"{name}[{k}]" for name, n in zip(called, count.tolist(), strict=True) for k in range(n)
        ]

    return columns(model.actuator_ctrlnum), columns(model.actuator_outnum)


def pulled_bodies(model: "mujoco.MjModel") -> dict[str, list[list[str]]]:
    """Names of the bodies whose joints each output of an `actuator`, and each `tendon`, acts on, by Jacobians at qpos0."""
    import mujoco
    import numpy as np

    if not model.nu and not model.ntendon:
        return {"actuator": [], "tendon": []}
    data = mujoco.MjData(model)
    mujoco.mj_fwdPosition(model, data)
    bodies = np.array(names(model, "body", model.nbody))[model.dof_bodyid]

    def touched(address: Any, count: Any, column: Any) -> list[list[str]]:
        return [sorted(set(bodies[column[a : a + n]])) for a, n in zip(address, count, strict=True)]

    moment = (data.moment_rowadr, data.moment_rownnz, data.moment_colind)
    tendon = (model.ten_J_rowadr, model.ten_J_rownnz, model.ten_J_colind)
    return {
        "actuator": touched(*moment) if model.nu else [],
        "tendon": touched(*tendon) if model.ntendon else [],
    }


def _flags(enum: Any, prefix: str, bits: int) -> list[str]:
    """Names of the bits that are set."""
    return [
        name.removeprefix(prefix).lower()
        for name, bit in enum.__members__.items()
        if name.startswith(prefix) and bits & bit.value
    ]


def _model_name(model: "mujoco.MjModel") -> str:
    """The model's name: the first entry of its name table."""
    return bytes(model.names).split(b"\0", 1)[0].decode(errors="replace")
