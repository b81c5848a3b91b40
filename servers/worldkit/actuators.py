"""Motors and servos on joints. Whatever drives them is recorded as an intervention: the plan declares it.

>>> actuators.motor(spec, "push_motor", joint="pusher_slide", limit=70.0)
>>> # in control(): data.actuator("push_motor").ctrl[0] = PUSH_FORCE
"""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import mujoco


def motor(spec: "mujoco.MjSpec", name: str, *, joint: str, limit: float | None = None) -> "mujoco.MjsActuator":
    """Its control is its force (N on a slide, N·m on a hinge), at most `limit` either way.

    Raises ValueError for a joint that is not there. Source: MuJoCo manual, XML reference, `actuator/motor`.
    """
    made = _on_joint(spec, name, joint, limit)
    made.set_to_motor()
    return made


def position(
    spec: "mujoco.MjSpec", name: str, *, joint: str, gain: float, damping: float = 0.0, limit: float | None = None
) -> "mujoco.MjsActuator":
    """A servo that pulls the joint to its control (m or rad) with `gain` (N/m, N·m/rad) and `damping` (N·s/m, N·m·s/rad).

    Source: MuJoCo manual, `actuator/position` (force = kp (ctrl - q) - kv dq/dt).
    """
    made = _on_joint(spec, name, joint, limit)
    made.set_to_position(kp=gain, kv=damping)
    return made


def velocity(
    spec: "mujoco.MjSpec", name: str, *, joint: str, gain: float, limit: float | None = None
) -> "mujoco.MjsActuator":
    """A servo that brings the joint to its control (m/s or rad/s) with `gain` (N·s/m, N·m·s/rad).

    Source: MuJoCo manual, `actuator/velocity` (force = kv (ctrl - dq/dt)).
    """
    made = _on_joint(spec, name, joint, limit)
    made.set_to_velocity(kv=gain)
    return made


def _on_joint(spec: "mujoco.MjSpec", name: str, joint: str, limit: float | None) -> "mujoco.MjsActuator":
    import mujoco

    if spec.joint(joint) is None:
        known = ", ".join(j.name for j in spec.joints) or "none"
        raise ValueError(f"actuator {name}: there is no joint {joint!r}; known: {known}")
    made = spec.add_actuator(name=name, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    if limit is not None:
        made.forcelimited = mujoco.mjtLimited.mjLIMITED_TRUE
        made.forcerange = (-limit, limit)
    return made
