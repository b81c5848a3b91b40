"""Control of an arm with a gripper: joints held at angles, or its fingers' tip moved through space, by torques alone.

The motors' torques are all that acts: each law gives what the motors of `arms.Arm` are told, within their limits. Frames: z up;
of the hand, +Z points along the fingers and +X from one to the other. Source: O. Khatib, "A unified approach for motion and force
control of robot manipulators: the operational space formulation", IEEE J. Robotics and Automation 3(1), 1987.
"""

from typing import TYPE_CHECKING

from .arms import Arm

if TYPE_CHECKING:
    import mujoco
    import numpy as np

STIFFNESS = 400.0
"""1/s² of a joint, or of the tip along and about each axis: 20 rad/s, critically damped, whatever moves."""


class ArmControl:
    """One arm in a world; its joints and motors are called as the robot, `_`, own name."""

    def __init__(self, model: "mujoco.MjModel", name: str, arm: Arm) -> None:
        """Look its parts up.

        Raises:
            KeyError: a joint, motor or body of it is not in the world.
        """
        import numpy as np

        self.model, self.name, self.arm = model, name, arm
        joints = [model.joint(f"{name}_{joint}") for joint in (*arm.joints, arm.fingers[0])]
        self._angles = np.array([joint.qposadr[0] for joint in joints])
        self._rates = np.array([joint.dofadr[0] for joint in joints])
        self._motors = [model.actuator(f"{name}_{arm.motor(joint)}").id for joint in arm.driven]
        self._limits = np.array(arm.limits)
        self._hand = model.body(f"{name}_{arm.hand}").id
        self.base = model.body(name).id

    def angles(self, data: "mujoco.MjData") -> "np.ndarray":
        """(J,) of the arm's joints, rad."""
        return data.qpos[self._angles[:-1]].copy()

    def tip(self, data: "mujoco.MjData") -> "tuple[np.ndarray, np.ndarray]":
        """Between the tips of the fingers: position (3,), m, and the hand's axes (3, 3) as columns."""
        turn = data.xmat[self._hand].reshape(3, 3)
        return data.xpos[self._hand] + turn @ self.arm.tip, turn.copy()

    def hold(self, data: "mujoco.MjData", angles: "np.ndarray", grip: float) -> None:
        """Joint position control: each joint is pulled to its angle (J,), rad, as if all had one inertia; the fingers to `grip`, m of the
        first one's slide."""
        import numpy as np

        away, rate = angles - self.angles(data), data.qvel[self._rates[:-1]]
        self._drive(data, self._inertia(data) @ (STIFFNESS * away - 2 * np.sqrt(STIFFNESS) * rate), grip)

    def reach(
        self, data: "mujoco.MjData", place: "np.ndarray", turn: "np.ndarray", grip: float, *, going: "np.ndarray", load: float = 0.0
    ) -> None:  # fmt: skip
        """Operational space control: the tip is pulled to a place (3,), m, which goes on at `going` (3,), m/s, and the hand to axes
        (3, 3), as if it had one inertia in all directions; the fingers as in `hold`. `load` is what it carries, kg."""
        import mujoco
        import numpy as np

        at, axes = self.tip(data)
        along, about = np.zeros((3, self.model.nv)), np.zeros((3, self.model.nv))
        mujoco.mj_jac(self.model, data, along, about, at, self._hand)
        own = self._rates[:-1]
        jacobian = np.vstack((along, about))[:, own]
        inverse = np.linalg.solve(self._inertia(data), jacobian.T)
        away = np.concatenate((place - at, 0.5 * np.cross(axes.T, turn.T).sum(axis=0)))
        late = np.append(going, np.zeros(3)) - jacobian @ data.qvel[own]
        inertia = np.linalg.inv(jacobian @ inverse + 1e-3 * np.eye(6))  # where it is stretched out none is infinite
        force = inertia @ (STIFFNESS * away + 2 * np.sqrt(STIFFNESS) * late)
        force[:3] -= load * self.model.opt.gravity
        self._drive(data, jacobian.T @ force, grip)

    def _inertia(self, data: "mujoco.MjData") -> "np.ndarray":
        """(J, J) of the arm's joints."""
        import mujoco
        import numpy as np

        whole = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, data, whole)
        return whole[np.ix_(self._rates[:-1], self._rates[:-1])]

    def _drive(self, data: "mujoco.MjData", torques: "np.ndarray", grip: float) -> None:
        """Tell the motors, against gravity and whatever else the joints' own motion makes."""
        import numpy as np

        servo, slide = self.arm.grip, self._angles[-1]
        pull = servo.gain * (grip - data.qpos[slide]) - servo.damping * data.qvel[self._rates[-1]]
        told = np.append(torques + data.qfrc_bias[self._rates[:-1]], pull)
        data.ctrl[self._motors] = np.clip(told, -self._limits, self._limits)
