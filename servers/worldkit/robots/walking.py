"""Robots that walk under a policy: each tick it is shown all of them, and sets what their servos hold until the next.

WALKERS = robots.walkers(("go2",), "go2", "go2/walk.onnx")

def control(model, data):
    WALKERS(model, data, [robots.along(data, "go2", speed=0.8)])
"""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from . import policy_observations
from .gaits import GAITS, Gait
from .policies import Policy, read

if TYPE_CHECKING:
    import mujoco
    import numpy as np

MOST_TURNING = 0.5
"""rad/s that `along` asks for at most."""


class Walkers:
    """Robots of one kind under one policy; it writes `ctrl` of their servos, which are called as the robot, `_`, own name.

    It starts anew where time goes back, so that a repetition is the same run.
    """

    def __init__(self, names: Sequence[str], gait: Gait, policy: Policy) -> None:
        if policy.observation != gait.observation or policy.action != len(gait.joints):
            raise ValueError(
                f"policy {policy.name} takes {policy.observation} numbers and gives {policy.action}; this gait has "
                f"{gait.observation} and {len(gait.joints)}"
            )
        self.names, self.gait, self.policy = tuple(names), gait, policy
        self._time = float("inf")
        self._next = 0.0

    def due(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> bool:
        """Whether the policy is asked at this state: what is costly to find out for it can wait until then."""
        return bool(data.time < self._time or data.time >= self._next - 0.5 * model.opt.timestep)

    def __call__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        commands: "Sequence[Sequence[float]] | np.ndarray",
        held: "np.ndarray | None" = None,
    ) -> None:
        """Set the servos, at a tick anew.

        Args:
            model: the world's.
            data: its state, up to date.
            commands: one for each robot: (forward m/s, left m/s, turning left rad/s).
            held: (N, J) rad, what servos hold whatever the policy says; not a number where it decides.

        Raises:
            PolicyError: what the robots show is no number any more.
            KeyError: a robot's joint, servo or site is not in the world.
        """
        import numpy as np

        due = self.due(model, data)
        if data.time < self._time:
            self._start(model, float(data.time))
        self._time = float(data.time)
        if due:
            late = self._time - self._next >= self.gait.tick  # time leapt: ticks that were missed are not made up for
            self._next = (self._time if late else self._next) + self.gait.tick
            self._last = self.policy(self._shown(model, data, np.array(commands, dtype=float)))
            self._targets = np.asarray(self.gait.home) + np.asarray(self.gait.scale) * self._last
            if held is not None:
                self._targets = np.where(np.isnan(held), self._targets, held)
                self._last = np.where(np.isnan(held), self._last, 0.0)  # it is shown nothing that it did not do
        data.ctrl[self._actuators] = self._targets

    def _start(self, model: "mujoco.MjModel", time: float) -> None:
        import numpy as np

        own = [[f"{name}_{joint}" for joint in self.gait.joints] for name in self.names]
        self._angles = np.array([[model.joint(one).qposadr[0] for one in row] for row in own])
        self._rates = np.array([[model.joint(one).dofadr[0] for one in row] for row in own])
        self._actuators = np.array(
            [
                [model.actuator(f"{name}_{self.gait.servo(joint)}").id for joint in self.gait.joints]
                for name in self.names
            ]
        )
        self._seen = np.array([joint not in self.gait.unseen for joint in self.gait.joints], dtype=float)
        self._last = np.zeros(self._angles.shape)
        self._next = self._first = time

    def _shown(self, model: "mujoco.MjModel", data: "mujoco.MjData", commands: "np.ndarray") -> "np.ndarray":
        """(N, observation) what the policy is shown of the robots."""
        import numpy as np

        sites = [f"{name}_{self.gait.site}" for name in self.names]
        felt = np.array([policy_observations.felt(model, data, site) for site in sites])
        away = self._seen * (data.qpos[self._angles] - self.gait.home)
        shown = [felt, away, self._seen * data.qvel[self._rates], self._last, commands]
        if self.gait.strides:
            time = float(data.time) - self._first
            shown.append(
                np.array([policy_observations.stride(time, standing=not command.any()) for command in commands])
            )
        rows: np.ndarray = getattr(policy_observations, self.gait.shown)(*shown)
        return rows


def walkers(names: Sequence[str], gait: str, file: str, *, sha256: str = "") -> Walkers:
    """Robots under the policy of a file beside the program.

    Args:
        names: of their root bodies.
        gait: its key in `gaits.GAITS`.
        file: relative to the program's folder.
        sha256: of the file, where it is known.

    Raises:
        PolicyError: the file is none that walks this gait; `code` says why.
    """
    known = GAITS[gait]
    return Walkers(names, known, read(file, observation=known.observation, action=len(known.joints), sha256=sha256))


def along(
    data: "mujoco.MjData", name: str, *, speed: float, y: float | None = None, heading: float = 0.0
) -> tuple[float, float, float]:
    """The command that keeps a robot on a straight line: it steers back to the line, as a person would who holds the stick.

    Args:
        data: the state.
        name: the robot's root body.
        speed: along the line, m/s; 0 stands.
        y: of the line, m to the left of the world's origin as seen along it; None: it goes through where the model has the robot.
        heading: of the line, rad from +X.
    """
    import numpy as np

    body = data.body(name)
    facing = float(np.arctan2(body.xmat[3], body.xmat[0]))
    across = np.array((-np.sin(heading), np.cos(heading)))
    aside = float(across @ body.xpos[:2] - (across @ _start(data, name) if y is None else y))
    wanted = heading - np.clip(1.0 * aside, -0.5, 0.5)
    error = (wanted - facing + np.pi) % (2 * np.pi) - np.pi
    turning = float(np.clip(1.5 * error, -MOST_TURNING, MOST_TURNING)) if speed else 0.0
    return (speed, 0.0, turning)


def _start(data: "mujoco.MjData", name: str) -> "np.ndarray":
    """Where the model has a robot: (2,), m; of one without a free joint where it is fixed in its parent."""
    model = data.model
    body = model.body(name)
    free = body.jntnum[0] and model.jnt_type[body.jntadr[0]] == 0
    at = model.jnt_qposadr[body.jntadr[0]] if free else 0
    return model.qpos0[at : at + 2] if free else body.pos[:2]
