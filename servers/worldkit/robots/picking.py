"""An arm picks a thing up and puts it on another, by contact and friction of its fingers alone.

PICKER = robots.picker("yam", "yam", "mug", "shelf")

def control(model, data):
    PICKER(model, data)

The hand comes level from the side of its base, closes across the narrow side, lifts, swings round its base and puts the thing down on
a board of the other. Where it goes follows from where things are when it begins, and from how the thing lies in its fingers then.
"""

from dataclasses import dataclass
from typing import TYPE_CHECKING

from ..errors import WorldkitError
from .arm_control import ArmControl
from .arms import ARMS, Arm
from .graspable import boards, outline

if TYPE_CHECKING:
    import mujoco
    import numpy as np

ASIDE_DEG = (0, 15, -15, 30, -30, 45, -45)
"""From the line out of the arm's base, in the order in which the hand would rather come."""
STANDOFF_M = 0.09
"""From which it goes straight in, and to which it goes straight out."""
LIFT_M = 0.06
LOWER_M = 0.02
SETTLE_S = 0.5
"""For the fingers to close or to open."""
QUICKEST_S = 0.5
NEAR_M = 0.03
"""How far the hand may be from where it is to be when it closes or opens."""
BESIDE_M = 0.002
"""The least room between a finger and the thing, on each side."""


class PickError(WorldkitError):
    """What an arm is to do is beyond it; `code` says why: `too_wide`, `no_board`, `out_of_reach`."""

    def __init__(self, code: str, cause: str, place: str, next_move: str) -> None:
        super().__init__(cause, place, next_move)
        self.code = code


@dataclass(frozen=True)
class Pose:
    """Of the tip: where, m, and which way the level hand points, rad from +X."""

    place: "np.ndarray"
    heading: float

    @property
    def axes(self) -> "np.ndarray":
        """Of the hand, as columns."""
        import numpy as np

        c, s = np.cos(self.heading), np.sin(self.heading)
        return np.array([[-s, 0, c], [c, 0, s], [0, 1, 0.0]])

    def back(self, far: float) -> "Pose":
        """So far out of it, the way it came."""
        import numpy as np

        return Pose(self.place - far * np.array((np.cos(self.heading), np.sin(self.heading), 0)), self.heading)

    def up(self, far: float) -> "Pose":
        """So much higher."""
        import numpy as np

        return Pose(self.place + np.array((0, 0, far)), self.heading)


class Picker:
    """One arm, one thing, one place for it. It starts anew where time goes back, so that a repetition is the same run."""

    def __init__(
        self, name: str, arm: Arm, thing: str, support: str, *, board: int = -1, from_s: float = 0.0, speed: float = 0.25
    ) -> None:  # fmt: skip
        self.name, self.arm, self.thing, self.support = name, arm, thing, support
        self.board, self.from_s, self.speed = board, from_s, speed
        self._time = float("inf")

    def __call__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        """Drive the motors.

        Args:
            model: the world's.
            data: its state, up to date.

        Raises:
            PickError: the thing is wider than the hand or out of its reach, or there is no board where it is to be put.
            KeyError: a part of the arm, the thing or the support is not in the world.
        """
        if data.time < self._time:
            self._control = ArmControl(model, self.name, self.arm)
            self._home, self._stage, self._since = self._control.angles(data), -1, self.from_s
        self._time = time = float(data.time)
        if time < self.from_s or self._stage >= len(_STAGES):
            self._control.hold(data, self._home, 0.0 if time < self.from_s else self.arm.open_m)
            return
        if self._stage < 0 or time >= self._since + self._lasts:
            self._arrived(data)
            self._begin(model, data, time)
        if self._stage >= len(_STAGES):
            self._home = self._control.angles(data)
            return
        step = float(model.opt.timestep)
        pose, ahead = (self._between((time + after - self._since) / self._lasts) for after in (0.0, step))
        going = (ahead.place - pose.place) / step
        self._control.reach(data, pose.place, pose.axes, self._grip, going=going, load=self._load)

    def _arrived(self, data: "mujoco.MjData") -> None:
        """Whether the hand is where it grasps, or where it puts the thing down."""
        import numpy as np

        what = {_GRASPS: self.thing, _PUTS: self.support}.get(self._stage)
        if what is not None and (away := float(np.linalg.norm(self._now(data).place - self._to.place))) > NEAR_M:
            raise PickError(
                "out_of_reach", f"the hand of `{self.name}` stays {1000 * away:.0f} mm from where it is to be at `{what}`", what,
                "move it nearer to the arm's base, to another height, or out of what is in the way",
            )  # fmt: skip

    def _begin(self, model: "mujoco.MjModel", data: "mujoco.MjData", time: float) -> None:
        """The next stage: where from, where to, how long."""
        import numpy as np

        self._stage, self._since = self._stage + 1, time
        if self._stage >= len(_STAGES):
            return
        if self._stage == 0:
            self._to = self._now(data)
            self._held = self._grasp(model, data)
            self._put = self._placing(model, data, self._held)
        if self._stage == _CARRY:
            self._put = self._placing(model, data, self._now(data))
        name, self._round, closed = _STAGES[self._stage]
        self._grip = 0.0 if closed else self.arm.open_m
        lifted = closed and name != "hold"
        self._load = float(model.body_subtreemass[model.body(self.thing).id]) if lifted else 0.0
        self._from, self._to = self._to, getattr(self, f"_{name}")()
        far = float(np.linalg.norm(self._to.place - self._from.place))
        turned = abs(_angle(self._to.heading - self._from.heading)) * 0.3
        self._lasts = SETTLE_S if far + turned == 0 else max(QUICKEST_S, 1.875 * max(far, turned) / self.speed)

    def _between(self, share: float) -> Pose:
        """With the least jerk from one pose to the next; round the base where the way is long."""
        import numpy as np

        s = float(np.clip(share, 0, 1))
        s = s**3 * (10 - 15 * s + 6 * s * s)
        a, b = self._from, self._to
        heading = a.heading + s * _angle(b.heading - a.heading)
        if not self._round:
            return Pose(a.place + s * (b.place - a.place), heading)
        start, end = a.place - self._base, b.place - self._base
        away = (1 - s) * np.hypot(*start[:2]) + s * np.hypot(*end[:2])
        first = np.arctan2(start[1], start[0])
        angle = first + s * _angle(float(np.arctan2(end[1], end[0]) - first))
        height = (1 - s) * start[2] + s * end[2]
        return Pose(self._base + np.array((away * np.cos(angle), away * np.sin(angle), height)), heading)

    def _grasp(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> Pose:
        """Where the tip is when it holds the thing: the fingers on both sides of its middle."""
        import numpy as np

        self._base = data.xpos[self._control.base].copy()
        points, middle = outline(model, data, self.thing), data.subtree_com[model.body(self.thing).id]
        outward = float(np.arctan2(*(middle - self._base)[1::-1]))
        widths = []
        for aside in np.radians(ASIDE_DEG):
            heading = outward + float(aside)
            along, across = np.array((np.cos(heading), np.sin(heading))), np.array((-np.sin(heading), np.cos(heading)))
            sides, depths = points[:, :2] @ across, points[:, :2] @ along
            widths.append(float(np.ptp(sides)))
            if widths[-1] > self.arm.width_m - 2 * BESIDE_M:
                continue
            deep = min(float(middle[:2] @ along) + 2 * self.arm.pad_m, float(depths.min()) + self.arm.depth_m)
            flat = deep * along + (sides.min() + sides.max()) / 2 * across
            return Pose(np.append(flat, middle[2]), heading)
        raise PickError(
            "too_wide", f"`{self.thing}` is {1000 * min(widths):.0f} mm wide as `{self.name}` comes to it, and its fingers open to "
            f"{1000 * self.arm.width_m:.0f} mm", self.thing, "turn it, so that a narrower side lies across, or make it smaller",
        )  # fmt: skip

    def _now(self, data: "mujoco.MjData") -> Pose:
        import numpy as np

        at, axes = self._control.tip(data)
        return Pose(at, float(np.arctan2(axes[1, 2], axes[0, 2])))

    def _placing(self, model: "mujoco.MjModel", data: "mujoco.MjData", holding: Pose) -> Pose:
        """Where the tip is when the thing that it holds as it is now stands in the middle of the board."""
        import numpy as np

        points = outline(model, data, self.thing)
        low, high = points.min(axis=0), points.max(axis=0)
        across = float(min(high[:2] - low[:2]))
        found = boards(model, data, self.support, across)
        count = len(found)
        if not -count <= self.board < count:
            raise PickError(
                "no_board", f"`{self.support}` has {count} faces that are {1000 * across:.0f} mm wide both ways", self.support,
                "give it a board that is wide enough, or leave `board` out for the highest",
            )  # fmt: skip
        board = found[self.board]
        at = holding.place
        outward = float(np.arctan2(*(board - self._base)[1::-1]))
        heading = outward + _angle(self._held.heading - float(np.arctan2(*(self._held.place - self._base)[1::-1])))
        away, turn = (low + high)[:2] / 2 - at[:2], heading - holding.heading
        c, s = np.cos(turn), np.sin(turn)
        flat = board[:2] - np.array((c * away[0] - s * away[1], s * away[0] + c * away[1]))
        return Pose(np.append(flat, board[2] + at[2] - low[2]), heading)

    def _ready(self) -> Pose:
        return self._held.back(STANDOFF_M)

    def _hold(self) -> Pose:
        return self._held

    def _lift(self) -> Pose:
        return self._held.up(max(LIFT_M, float(self._put.place[2] - self._held.place[2]) + LOWER_M))

    def _before(self) -> Pose:
        return self._put.up(LOWER_M).back(STANDOFF_M)

    def _above(self) -> Pose:
        return self._put.up(LOWER_M)

    def _down(self) -> Pose:
        return self._put

    def _away(self) -> Pose:
        return self._put.back(STANDOFF_M)


_STAGES = (
    ("ready", True, False), ("hold", False, False), ("hold", False, True), ("lift", False, True), ("before", True, True),
    ("above", False, True), ("down", False, True), ("down", False, False), ("away", False, False),
)  # fmt: skip
"""Where the tip goes, whether round the base, whether the fingers are closed."""
_GRASPS, _CARRY, _PUTS = 1, 4, 6


def picker(
    name: str, arm: str, thing: str, support: str, *, board: int = -1, from_s: float = 0.0, speed: float = 0.25
) -> Picker:
    """An arm that picks a thing and places it on another.

    Args:
        name: the arm's root body.
        arm: its key in `arms.ARMS`.
        thing: the body that it picks.
        support: the body that it places it on.
        board: which of the support's upper faces, 0 the lowest, -1 the highest.
        from_s: when it begins, s.
        speed: the most of its tip, m/s.
    """
    return Picker(name, ARMS[arm], thing, support, board=board, from_s=from_s, speed=speed)


def _angle(rad: float) -> float:
    """In [-pi, pi)."""
    import math

    return (rad + math.pi) % (2 * math.pi) - math.pi
