"""Initial motion: where joints start, and how fast everything moves at t = 0.

The motion is stored in the model itself, as keyframe "start", so that `build()` alone gives a complete world.
"""

import copy
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco
    import numpy as np

Vec3 = tuple[float, float, float]
START = "start"
"""Name of the keyframe that a run begins from."""


@dataclass(frozen=True)
class Launch:
    """Motion of a free body, or of a joint, at t = 0.

    For a body with a free joint: `linear` is the velocity of its origin (m/s) and `angular` its angular velocity
    (rad/s), both in the world frame. A ball joint takes `angular`, in the world frame at the initial pose.
    A hinge or slide takes `position` (rad or m, from the pose in which the joint was defined) and `velocity`
    (rad/s or m/s).
    """

    linear: Vec3 = (0.0, 0.0, 0.0)
    angular: Vec3 = (0.0, 0.0, 0.0)
    position: float | None = None
    velocity: float | None = None


def launch(spec: "mujoco.MjSpec", motions: Mapping[str, Launch]) -> None:
    """Add keyframe "start": the initial pose with these velocities. Call it last, when every body is there.

    Joints of a closed loop that are not named move along with those that are (`follow_loops`).

    Args:
        spec: the finished world.
        motions: by name of a body with a free joint, or of a joint.

    Raises:
        ValueError: an unknown name (the known ones are listed), a motion that its joint cannot make, a second launch.
    """
    import mujoco
    import numpy as np

    if any(key.name == START for key in spec.keys):
        raise ValueError('motion.launch: keyframe "start" exists already; put all motions into one call')
    model = spec.copy().compile()
    data = mujoco.MjData(model)
    mujoco.mj_kinematics(model, data)
    qpos, qvel = model.qpos0.copy(), np.zeros(model.nv)
    for name, motion in motions.items():
        joint = _joint(model, name)
        kind = mujoco.mjtJoint(model.jnt_type[joint])
        q, v = model.jnt_qposadr[joint], model.jnt_dofadr[joint]
        scalar = kind in (mujoco.mjtJoint.mjJNT_HINGE, mujoco.mjtJoint.mjJNT_SLIDE)
        _check(name, motion, kind)
        if scalar:
            qpos[q] += motion.position or 0.0
            qvel[v] = motion.velocity or 0.0
            continue
        rotation = data.xmat[model.jnt_bodyid[joint]].reshape(3, 3)
        local = rotation.T @ np.asarray(motion.angular, dtype=float)  # MuJoCo keeps it in the body's own frame
        if kind == mujoco.mjtJoint.mjJNT_FREE:
            qvel[v : v + 3] = motion.linear
            qvel[v + 3 : v + 6] = local
        else:
            qvel[v : v + 3] = local
    follow_loops(model, qpos, qvel, [_joint(model, name) for name in motions])
    key = spec.add_key(name=START)
    key.qpos, key.qvel = qpos, qvel
    if model.nmocap:
        key.mpos, key.mquat = data.mocap_pos.ravel(), data.mocap_quat.ravel()


def follow_loops(model: "mujoco.MjModel", qpos: "np.ndarray", qvel: "np.ndarray", started: Sequence[int]) -> None:
    """Let the other hinges, slides and balls of a closed loop move along with those that were started, in place.

    When one pin of a linkage has a speed and the others do not, the loop tears: the engine would close it within a step, by a
    blow that takes energy. Of the speeds that keep J v = 0 for the connects and welds, J being their Jacobian, the
    smallest are taken; where none do, nothing changes. Free bodies are left as they are: of bodies that are glued together and
    thrown, each is given its own motion.

    Args:
        model: the finished world.
        qpos: (nq,) the start.
        qvel: (nv,) the speeds given; changed in place.
        started: ids of the joints whose speed is given.

    Source: R. Featherstone, Rigid Body Dynamics Algorithms, section 8.2 (loop constraints on velocities).
    """
    import mujoco
    import numpy as np

    ties = (int(mujoco.mjtEq.mjEQ_CONNECT), int(mujoco.mjtEq.mjEQ_WELD))
    if not np.isin(model.eq_type[model.eq_active0.astype(bool)], ties).any() or not qvel.any():
        return
    kinds, joints = model.jnt_type[model.dof_jntid], model.dof_jntid
    follows = (kinds != int(mujoco.mjtJoint.mjJNT_FREE)) & ~np.isin(joints, list(started))
    model = copy.copy(model)
    model.opt.jacobian = mujoco.mjtJacobian.mjJAC_DENSE
    data = mujoco.MjData(model)
    data.qpos[:] = qpos
    mujoco.mj_forward(model, data)
    tied = (data.efc_type == int(mujoco.mjtConstraint.mjCNSTR_EQUALITY)) & np.isin(
        model.eq_type[data.efc_id % model.neq], ties
    )
    rows = data.efc_J.reshape(-1, model.nv)[tied]
    pulled = rows @ qvel
    if np.abs(pulled).max(initial=0.0) < 1e-9:
        return
    found = np.linalg.lstsq(rows[:, follows], -pulled, rcond=1e-9)[0]
    if np.abs(rows[:, follows] @ found + pulled).max() < 1e-6 * np.abs(pulled).max():
        qvel[follows] += found


def _joint(model: "mujoco.MjModel", name: str) -> int:
    """The joint of this name, else the free joint of the body of this name."""
    import mujoco

    joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
    if joint >= 0:
        return joint
    body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name)
    if body >= 0 and model.body_jntnum[body] == 1:
        return int(model.body_jntadr[body])
    free = [model.body(b).name for b in range(1, model.nbody) if model.body_jntnum[b] == 1]
    joints = [model.joint(j).name for j in range(model.njnt) if model.joint(j).name]
    if body >= 0:
        has = "no joint (it is part of the scenery)" if not model.body_jntnum[body] else "several joints: name one"
        cause = f"body {name!r} has {has}"
    else:
        cause = f"there is no body or joint {name!r}"
    raise ValueError(
        f"motion.launch: {cause}; bodies: {', '.join(free) or 'none'}; joints: {', '.join(joints) or 'none'}"
    )


def _check(name: str, motion: Launch, kind: "mujoco.mjtJoint") -> None:
    """A motion must be finite, and one that its joint can make."""
    import math

    numbers = (*motion.linear, *motion.angular, motion.position or 0.0, motion.velocity or 0.0)
    if not all(math.isfinite(number) for number in numbers):
        raise ValueError(f"motion.launch: {name}: every number must be finite, got {motion}")
    word = kind.name.removeprefix("mjJNT_").lower()
    if word in ("hinge", "slide") and (any(motion.linear) or any(motion.angular)):
        raise ValueError(f"motion.launch: {name} moves on a {word} joint: give position and velocity")
    if word in ("free", "ball") and (motion.position is not None or motion.velocity is not None):
        raise ValueError(f"motion.launch: {name} moves on a {word} joint: give linear and angular velocities")
    if word == "ball" and any(motion.linear):
        raise ValueError(f"motion.launch: {name} moves on a ball joint: it has no linear velocity of its own")
