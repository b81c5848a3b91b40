"""What pushes during a step, and the work it did: forces and torques, controls, moved mocap bodies.

A push is noticed before the step and told after it, when the velocities at the step's end are known: the work of a
force that is constant over a step is that force times the mean of the velocities at both ends, times the step.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

from .columns import VALUES
from .describe import actuator_columns, names, pulled_bodies

if TYPE_CHECKING:
    import mujoco
    import numpy as np

Event = Callable[..., None]
"""`Recorder.event`: table name, then values in the order of its columns."""


class Pushes:
    """Pending pushes of one step; told through `event` once their work is known."""

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", event: Event) -> None:
        self._model, self._data, self._event = model, data, event
        self._bodies = names(model, "body", model.nbody)
        self._joints = names(model, "joint", model.njnt)
        pulled = pulled_bodies(model)["actuator"]
        controls, _ = actuator_columns(model)
        self._output = _outputs(model)
        self._actuators = [  # `body/actuator` when it moves one body's joint
            f"{pulled[output][0]}/{name}" if len(pulled[output]) == 1 else name
            for name, output in zip(controls, self._output.tolist(), strict=True)
        ]
        self._on_bodies: list[tuple[str, int, np.ndarray, np.ndarray]] = []
        self._on_joints: list[tuple[str, str, slice, np.ndarray, np.ndarray, np.ndarray]] = []
        self._driven: np.ndarray | None = None
        self._control: np.ndarray | None = None
        self._force: np.ndarray | None = None
        self._speed: np.ndarray | None = None
        self._mocap: list[tuple[float, int, np.ndarray]] = []
        self._time = 0.0

    def external(self) -> None:
        """`xfrc_applied`: forces and torques on bodies, at their centres of mass, world frame."""
        import numpy as np

        self._time = self._data.time
        wrench = self._data.xfrc_applied
        for body in np.flatnonzero(wrench.any(axis=1)):
            motion = twist(self._model, self._data, int(body))
            for kind, part in (("force", slice(0, 3)), ("torque", slice(3, 6))):
                if wrench[body, part].any():
                    value = np.zeros(VALUES)
                    value[part] = wrench[body, part]
                    self._on_bodies.append((kind, int(body), value, motion))

    def generalised(self, force: "np.ndarray") -> None:
        """A force (nv,) on the joints, told as force or torque on the bodies that own them, world frame."""
        import mujoco
        import numpy as np

        model, data = self._model, self._data
        self._time = data.time
        for joint in owners(model.jnt_dofadr, np.flatnonzero(force)):
            kind = mujoco.mjtJoint(model.jnt_type[joint])
            body, first = int(model.jnt_bodyid[joint]), int(model.jnt_dofadr[joint])
            rotation = data.xmat[body].reshape(3, 3)
            target = self._bodies[body]
            if model.body_jntnum[body] > 1:
                target = f"{target}/{self._joints[joint]}"
            three, one = slice(first, first + 3), slice(first, first + 1)
            parts: list[tuple[str, slice, np.ndarray]]
            if kind == mujoco.mjtJoint.mjJNT_FREE:
                last = slice(first + 3, first + 6)
                parts = [("force", three, force[three]), ("torque", last, rotation @ force[last])]
            elif kind == mujoco.mjtJoint.mjJNT_BALL:
                parts = [("torque", three, rotation @ force[three])]
            elif kind == mujoco.mjtJoint.mjJNT_HINGE:
                parts = [("torque", one, data.xaxis[joint] * force[first])]
            else:
                parts = [("force", one, data.xaxis[joint] * force[first])]
            for word, dofs, vector in parts:
                if vector.any():
                    value = np.zeros(VALUES)
                    value[slice(0, 3) if word == "force" else slice(3, 6)] = vector
                    # Forces and velocities of joints are dual: their product is the power, whatever their frame.
                    self._on_joints.append((word, target, dofs, value, force[dofs].copy(), data.qvel[dofs].copy()))

    def controls(self, which: "np.ndarray") -> None:
        """These actuators (ids) are given a control."""
        if len(which):
            self._time, self._driven = self._data.time, which
            self._control = self._data.ctrl[which].copy()
            self._speed = self._data.actuator_velocity[self._output[which]].copy()

    def carried(self, body: int, moved: "np.ndarray") -> None:
        """A mocap body was moved by this displacement and rotation vector."""
        self._mocap.append((self._data.time, body, moved))

    def reacted(self) -> None:
        """Forces are computed: what actuators exert, and what the world does to the mocap bodies that were moved."""
        import mujoco

        if self._driven is not None:
            self._force = self._data.actuator_force[self._output[self._driven]].copy()
        if not self._mocap:
            return
        mujoco.mj_rnePostConstraint(self._model, self._data)
        for time, body, moved in self._mocap:
            torque, force = self._data.cfrc_ext[body, :3], self._data.cfrc_ext[body, 3:]
            work = -float(force @ moved[:3] + torque @ moved[3:])
            self._event("interventions", time, "mocap", self._bodies[body], tuple(moved), work)
        self._mocap.clear()

    def settle(self) -> None:
        """The next velocities are computed: tell what pushed, with its work."""
        if not (self._on_bodies or self._on_joints or self._driven is not None):
            return
        model, data, time = self._model, self._data, self._time
        step = data.time - time
        for kind, body, value, before in self._on_bodies:
            work = float(value @ (before + twist(model, data, body))) / 2 * step
            self._event("interventions", time, kind, self._bodies[body], tuple(value), work)
        for kind, target, dofs, value, force, speed in self._on_joints:
            work = float(force @ (speed + data.qvel[dofs])) / 2 * step
            self._event("interventions", time, kind, target, tuple(value), work)
        if self._driven is not None:
            assert self._force is not None and self._speed is not None and self._control is not None
            speed = (self._speed + data.actuator_velocity[self._output[self._driven]]) / 2
            works = self._force * speed * step
            for actuator, control, exerted, work in zip(self._driven, self._control, self._force, works, strict=True):
                told = (float(control), float(exerted), *(0.0,) * (VALUES - 2))
                self._event("interventions", time, "control", self._actuators[actuator], told, float(work))
        self._on_bodies.clear()
        self._on_joints.clear()
        self._driven = None


def twist(model: "mujoco.MjModel", data: "mujoco.MjData", body: int) -> "np.ndarray":
    """(6,) linear velocity of a body's centre of mass and its angular velocity, world frame."""
    import numpy as np

    spin, linear = data.cvel[body, :3], data.cvel[body, 3:]
    arm = data.xipos[body] - data.subtree_com[model.body_rootid[body]]
    return np.concatenate((linear + np.cross(spin, arm), spin))


def _outputs(model: "mujoco.MjModel") -> "np.ndarray":
    """(nu,) the force output of each control: an orientation actuator has three, one for each of its controls."""
    import numpy as np

    found = [
        first + min(k, outputs - 1)
        for first, outputs, controls in zip(
            model.actuator_outadr.tolist(), model.actuator_outnum.tolist(), model.actuator_ctrlnum.tolist(), strict=True
        )
        for k in range(controls)
    ]
    return np.array(found, dtype=int)


def owners(addresses: "np.ndarray", indices: "np.ndarray") -> list[int]:
    """Which joints own these entries of qpos or qvel, given each joint's first address."""
    import numpy as np

    return [int(j) for j in np.unique(np.searchsorted(addresses, indices, side="right") - 1)]
