"""Describe what holds bodies together: joints with their ranges, ties with their anchors, ropes with their way.

With such a row, a recorded pose tells whether a limit or a tie holds, without the simulator.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import mujoco


def joint(model: "mujoco.MjModel", j: int) -> dict[str, Any]:
    """`range` (rad or m from the reference pose), `axis` (body frame), and the reference pose in the parent's frame.

    It is empty where a pose alone does not tell the coordinate: no limit, a ball or free joint, several joints of one body.
    """
    import mujoco

    body, kind = int(model.jnt_bodyid[j]), mujoco.mjtJoint(model.jnt_type[j])
    simple = kind in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
    if not (model.jnt_limited[j] and simple and model.body_jntnum[body] == 1):
        return {}
    return {
        "range": (model.jnt_range[j] - model.qpos0[model.jnt_qposadr[j]]).tolist(),
        "axis": model.jnt_axis[j].tolist(),
        "pos0": model.body_pos[body].tolist(),
        "quat0": model.body_quat[body].tolist(),
    }


def tie(model: "mujoco.MjModel", home: "mujoco.MjData", e: int, bodies: list[str]) -> dict[str, Any]:
    """`ends` (two body names) and `anchors` (a point in each one's frame, m) of a weld or a connect; otherwise empty.

    Args:
        home: the model in its reference pose, `mj_kinematics` done.
    """
    import mujoco
    import numpy as np

    kind = mujoco.mjtEq(model.eq_type[e])
    if kind not in (mujoco.mjtEq.mjEQ_CONNECT, mujoco.mjtEq.mjEQ_WELD):
        return {}
    ids = (int(model.eq_obj1id[e]), int(model.eq_obj2id[e]))
    if mujoco.mjtObj(model.eq_objtype[e]) == mujoco.mjtObj.mjOBJ_SITE:
        ends = [int(model.site_bodyid[i]) for i in ids]
        anchors = [model.site_pos[i].tolist() for i in ids]
    else:
        # A connect keeps its anchor in both bodies' frames; a weld in the second's, then the relative pose.
        ends = list(ids)
        second = np.array(model.eq_data[e, :3] if kind == mujoco.mjtEq.mjEQ_WELD else model.eq_data[e, 3:6])
        point = home.xpos[ids[1]] + home.xmat[ids[1]].reshape(3, 3) @ second
        anchors = [(home.xmat[ids[0]].reshape(3, 3).T @ (point - home.xpos[ids[0]])).tolist(), second.tolist()]
    return {"ends": [bodies[i] for i in ends], "anchors": anchors}


def rope(model: "mujoco.MjModel", t: int, bodies: list[str]) -> dict[str, Any]:
    """`way` (a body name and a point in its frame, m, for each site) and `range` (m) of a limited spatial tendon.

    It is empty for fixed tendons, pulleys and tendons without a limit. Where a tendon wraps around a geom, the way from
    site to
    site is a lower bound of its length.
    """
    import mujoco

    first, count = int(model.tendon_adr[t]), int(model.tendon_num[t])
    kinds = [mujoco.mjtWrap(k) for k in model.wrap_type[first : first + count]]
    if not model.tendon_limited[t] or {mujoco.mjtWrap.mjWRAP_JOINT, mujoco.mjtWrap.mjWRAP_PULLEY} & set(kinds):
        return {}
    sites = [int(model.wrap_objid[first + k]) for k, kind in enumerate(kinds) if kind == mujoco.mjtWrap.mjWRAP_SITE]
    way = [[bodies[model.site_bodyid[s]], model.site_pos[s].tolist()] for s in sites]
    return {"way": way, "range": model.tendon_range[t].tolist()}
