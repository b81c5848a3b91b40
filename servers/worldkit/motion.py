"""Initial motion: where joints start, and how fast everything moves at t = 0.

The motion is stored in the model itself, as keyframe "start", so that `build()` alone gives a complete world.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco

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
    key = spec.add_key(name=START)
    key.qpos, key.qvel = qpos, qvel
    if model.nmocap:
        key.mpos, key.mquat = data.mocap_pos.ravel(), data.mocap_quat.ravel()


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
