"""How the bodies move that matter touches: as the engine has them, and between two questions as far as it is known."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import mujoco

Array = np.ndarray


class BodyMotion:
    """The bodies of a law, in its order.

    Args:
        model: the world.
        bodies: their numbers.
    """

    def __init__(self, model: "mujoco.MjModel", bodies: "Sequence[int] | Array") -> None:
        self._model, self._bodies = model, [int(body) for body in bodies]
        self._own = [self._of(body) for body in self._bodies]
        self._stood: dict[int, tuple[Array, Array]] = {}
        self.felt = np.zeros((len(self._bodies), 6))
        """N, N m: what they were given as the mean of the last question."""

    def now(self, data: "mujoco.MjData", seconds: float) -> Array:
        """(k, 9): middle, velocity there and spin of each, world frame; what is led by the hand goes on as in the last `seconds`."""
        import mujoco

        found, six = np.zeros((len(self._bodies), 9)), np.zeros(6)
        for row, body in enumerate(self._bodies):
            found[row, :3] = data.xipos[body]
            if self._model.body_mocapid[self._model.body_weldid[body]] >= 0:
                found[row, 3:] = self._led(body, data, seconds)
            elif body and self._model.body_weldid[body]:
                mujoco.mj_objectVelocity(self._model, data, mujoco.mjtObj.mjOBJ_XBODY, body, six, 0)
                found[row, 6:] = six[:3]
                found[row, 3:6] = six[3:] + np.cross(six[:3], data.xipos[body] - data.xpos[body])
        return found

    def carry(self, bodies: Array, before: Array, push: Array, seconds: float) -> None:
        """Let free bodies (k, 9) move on: as they last did (k, 6), but for what matter gave them then and `push` gives now, N s."""
        for row, own in enumerate(self._own):
            if own is not None:
                extra = push[row] - self.felt[row] * seconds
                bodies[row, 3:6] = before[row, :3] + extra[:3] / own[0]
                bodies[row, 6:] = before[row, 3:] + extra[3:] / own[1]

    def _of(self, body: int) -> "tuple[float, float] | None":
        """Mass, and largest moment of inertia, of a body that is free to move as it is pushed."""
        import mujoco

        joint = self._model.body_jntadr[body]
        if joint < 0 or self._model.jnt_type[joint] != mujoco.mjtJoint.mjJNT_FREE or not body:
            return None
        return float(self._model.body_subtreemass[body]), float(self._model.body_inertia[body].max())

    def _led(self, body: int, data: "mujoco.MjData", seconds: float) -> Array:
        """(6,) velocity and spin of a body whose place is given anew each time: the engine knows none of it."""
        import mujoco

        here, turned = np.array(data.xipos[body]), np.array(data.xquat[body])
        before, had = self._stood.get(body, (here, turned))
        self._stood[body] = here, turned
        back, turn, spin = np.zeros(4), np.zeros(4), np.zeros(3)
        mujoco.mju_negQuat(back, had)
        mujoco.mju_mulQuat(turn, turned, back)
        mujoco.mju_quat2Vel(spin, turn, seconds)
        return np.concatenate([(here - before) / seconds, spin])
