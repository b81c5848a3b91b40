"""A match: two teams of walkers that play a ball, all under one policy, asked once a tick for all of them.

MATCH = robots.match({"red_1": (10, 0), "red_2": (10, 0), "blue_1": (-10, 0)}, "t1", "t1/walk.onnx", ball="ball", speed=0.6)

def control(model, data):
    MATCH(model, data)  # every 0.02 s is enough: program.main(..., control_every=10) at 2 ms

Who falls is counted, holds its home pose and takes no part any more: the others close up (`teams`, `fallen`).
"""

from collections.abc import Mapping
from typing import TYPE_CHECKING

from . import teams
from .fallen import Falls
from .walking import Walkers, walkers

if TYPE_CHECKING:
    import mujoco


class Match:
    """Called as `(model, data)` in `control`; `falls` tells who lies."""

    def __init__(self, robots: Walkers, goals: Mapping[str, tuple[float, float]], ball: str, speed: float) -> None:
        import numpy as np

        sides = list(dict.fromkeys(goals.values()))
        if len(sides) != 2 or set(goals) != set(robots.names):
            raise ValueError(f"a match has two goals, and every walker shoots at one of them; here are {len(sides)}")
        self.walkers, self.ball, self.speed = robots, ball, speed
        self.goals = np.array(sides, dtype=float)
        self.side = np.array([sides.index(goals[name]) for name in robots.names])
        self.falls = Falls(robots.names, robots.gait)

    def __call__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Set the servos of all players.

        Raises:
            PolicyError: what a robot shows is no number any more.
            KeyError: a player, its servos or the ball are not in the world.
        """
        import numpy as np

        names = self.walkers.names
        if not self.walkers.due(model, data):
            return
        able, held = self.falls(data)
        at, turns = np.array([data.body(name).xpos for name in names]), [data.body(name).xmat for name in names]
        homes = np.array([model.qpos0[model.jnt_qposadr[model.body(name).jntadr[0]] :][:2] for name in names])
        yaw = np.array([np.arctan2(turn[3], turn[0]) for turn in turns])
        wanted = teams.order(self.side, homes, self.goals, at[:, :2], data.body(self.ball).xpos[:2], able, self.speed)
        self.walkers(model, data, teams.told(wanted, yaw), held)


def match(
    goals: Mapping[str, tuple[float, float]], gait: str, file: str, *, ball: str, speed: float, sha256: str = ""
) -> Match:
    """A match of robots under the policy of a file beside the program.

    Args:
        goals: of each player, by the name of its root body: the goal that it shoots at, m. The two goals make the teams; where
            the model has a player is its place while the ball is in the middle between them.
        gait: its key in `gaits.GAITS`.
        file: relative to the program's folder.
        ball: its body.
        speed: of a player that walks, m/s.
        sha256: of the file, where it is known.

    Raises:
        PolicyError: the file is none that walks this gait; `code` says why.
    """
    return Match(walkers(tuple(goals), gait, file, sha256=sha256), goals, ball, speed)
