"""Two teams that play a ball: who goes for it, where the others stand, how each keeps clear of the rest; from the state alone.

The nearest of a team goes behind the ball, as seen from the goal that its team shoots at, and walks on through it. Where the other
team is nearer, it does not meet that one head on: it stays between the ball and its own goal. All others hold their places in the
team's order, which moves along with the ball. Nothing is drawn by lot, nothing is remembered: the same state, the same orders.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import numpy as np

BEHIND_M = 0.5
"""Of the ball, from where a player goes for the goal."""
CONTAIN_M = 1.5
"""Of the ball, on the way to one's own goal, where the second nearest waits."""
CLEAR_M = 1.2
"""From middle to middle: nearer than this two players step apart; the arms of a T1 reach 0.5 m to either side."""
ALONG = 0.3
"""m that the order of a team moves for 1 m of the ball."""
NEAR_M = 0.25
"""What counts as there."""


@dataclass(frozen=True)
class Order:
    """What players of two teams want at a moment, row by row."""

    velocity: "np.ndarray"
    """(N, 2) m/s, in the world."""
    facing: "np.ndarray"
    """(N,) rad, where they look."""
    on_ball: "np.ndarray"
    """(N,) who goes for the ball."""


def order(
    side: "np.ndarray", homes: "np.ndarray", goals: "np.ndarray", at: "np.ndarray", ball: "np.ndarray", able: "np.ndarray", speed: float
) -> Order:  # fmt: skip
    """What each player wants.

    Args:
        side: (N,) 0 or 1.
        homes: (N, 2) m, where each stands while the ball is in the middle.
        goals: (2, 2) m, the goal that each side shoots at.
        at: (N, 2) m, where they are.
        ball: (2,) m.
        able: (N,) who is on its feet; of the others nothing is wanted.
        speed: of a player, m/s.
    """
    import numpy as np

    target = homes + ALONG * (ball - goals.mean(axis=0))
    on_ball = np.zeros(len(at), dtype=bool)
    away = np.where(able, np.linalg.norm(at - ball, axis=1), np.inf)
    chasers = {own: int(np.argmin(np.where(side == own, away, np.inf))) for own in (0, 1) if able[side == own].any()}
    first = min(chasers.values(), key=lambda row: float(away[row]), default=-1)
    for own, row in chasers.items():
        if row == first:
            target[row], on_ball[row] = _shooting(at[row], ball, goals[own]), True
        else:
            target[row] = ball + CONTAIN_M * _unit(goals[1 - own] - ball)
    way = target - at
    far = np.linalg.norm(way, axis=1)
    pace = np.where(on_ball, speed, np.where(far > NEAR_M, np.minimum(far, speed), 0.0))
    velocity = way / np.maximum(far, 1e-9)[:, None] * pace[:, None] + speed * _apart(at)
    size = np.linalg.norm(velocity, axis=1)
    velocity *= (able * np.minimum(1.0, speed / np.maximum(size, 1e-9)))[:, None]
    to_ball = np.arctan2(*(ball - at).T[::-1])
    walking = np.arctan2(velocity[:, 1], velocity[:, 0])
    return Order(velocity, np.where((size > 0.6 * speed) & (on_ball | (far > 1.0)), walking, to_ball), on_ball)


def told(wanted: Order, yaw: "np.ndarray") -> "np.ndarray":
    """(N, 3) what walkers are told: forward and left, m/s, turning left, rad/s; all nought of those that are to stand.

    Args:
        wanted: of each.
        yaw: (N,) rad, where it looks now.
    """
    import numpy as np

    error = (wanted.facing - yaw + np.pi) % (2 * np.pi) - np.pi
    x, y = wanted.velocity.T
    ahead, left = x * np.cos(yaw) + y * np.sin(yaw), y * np.cos(yaw) - x * np.sin(yaw)
    rows = np.stack((np.maximum(ahead, -0.3), np.clip(left, -0.3, 0.3), np.clip(1.5 * error, -0.8, 0.8)), axis=1)
    moves: np.ndarray = (np.hypot(x, y) > 0.1) | (np.abs(error) > 0.6)
    return rows * moves[:, None]


def _shooting(at: "np.ndarray", ball: "np.ndarray", goal: "np.ndarray") -> "np.ndarray":
    """Where a player goes that is to bring the ball to a goal: through it from behind, and around it until there."""
    import numpy as np

    aim, away = _unit(goal - ball), at - ball
    behind, beside = float(-aim @ away), float(aim[0] * away[1] - aim[1] * away[0])
    if behind > 0.1 and abs(beside) < 0.35 * behind + 0.08:
        return np.asarray(ball + 0.4 * aim - 0.6 * beside * np.array((-aim[1], aim[0])))
    start = ball - BEHIND_M * aim
    if behind < 0.2:  # it is before the ball, or level with it: by the side that it is on
        start = start + np.copysign(BEHIND_M, beside) * np.array((-aim[1], aim[0]))
    return np.asarray(start)


def _apart(at: "np.ndarray") -> "np.ndarray":
    """(N, 2) how each steps away from those that are near: 1 and more where two touch, nought at `CLEAR_M`."""
    import numpy as np

    way = at[:, None] - at[None]
    far = np.linalg.norm(way, axis=2)
    np.fill_diagonal(far, np.inf)
    push = np.clip((CLEAR_M - far) / (0.5 * CLEAR_M), 0.0, 2.0)
    stepped: np.ndarray = (way / far[:, :, None] * push[:, :, None]).sum(axis=1)
    return stepped


def _unit(way: "np.ndarray") -> "np.ndarray":
    import numpy as np

    unit: np.ndarray = way / max(float(np.linalg.norm(way)), 1e-9)
    return unit
