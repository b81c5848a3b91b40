"""An accepted world as a Gymnasium environment.

Action: the declared controls (`kind: control` of the plan's interventions), in the engine's order, each in the unit and between
the bounds that `controls.control_inputs` found; one action acts for `control_every` steps of the program. What else the plan
declares acts as it was recorded. Observation: `observations.columns`, as a dict or in one row. Reward and end: the plan's
objectives as far as they can be judged while it runs (`judging`); the return of the recorded actions is 1. An episode is
truncated after the plan's duration. Nothing of the program is run, and what a learner makes of it is no evidence of the plan.
"""

from collections.abc import Mapping
from copy import deepcopy
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np

from ..model.errors import GateError, NotFoundError
from .accepted_world import AcceptedWorld
from .controls import checked, control_inputs
from .episode import Episode
from .jitter import Jitter, shake
from .judging import Judge
from .observations import columns, flat
from .stepping import Stepped


class World(gymnasium.Env):
    """One accepted world.

    Args:
        run: its folder, its plan.md, or its name under ./runs or ./examples.
        render_mode: None or `rgb_array`.
        camera: a camera of the plan; the first without it.
        observation: `columns` for a dict, `flat` for one row.
        reward: False judges nothing: every reward is 0, nothing ends but by the clock, and nothing is kept.
        judge_every_s: simulated seconds from one judgement to the next; 0 judges after every action.
        jitter: how far the start may be off (`jitter.shake`); `reset(options={"jitter": …})` says it for one episode.
        bounds: bounds of actions by the control's name, in its unit, in place of those that were found.
        judge: of another copy of this world, whose making costs a whole episode; this copy gets rows of its own.

    Attributes:
        inputs: the controls, with units, bounds and who says so.
        judge: what is judged and what is not, with reasons; None without rewards.

    Raises:
        GateError: nothing is accepted, or plain MuJoCo does not step it.
        NotFoundError: no such run, camera or control.
    """

    metadata = {"render_modes": ["rgb_array"], "render_fps": 24}

    def __init__(
        self,
        run: Path | str,
        render_mode: str | None = None,
        camera: str | None = None,
        observation: str = "columns",
        reward: bool = True,
        judge_every_s: float = 0.1,
        jitter: Jitter | None = None,
        bounds: Mapping[str, tuple[float, float]] | None = None,
        judge: Judge | None = None,
    ) -> None:
        from worldengine.recording.describing import describe

        self.world = AcceptedWorld.read(run)
        self.metadata = {**self.metadata, "render_fps": self.world.given.fps}
        if render_mode not in (None, "rgb_array") or observation not in ("columns", "flat"):
            cause = f"there is no render_mode {render_mode!r} with observation {observation!r}"
            raise NotFoundError(cause, next_move='render_mode: None, "rgb_array"; observation: "columns", "flat"')
        self.render_mode, self._camera, self.jitter = render_mode, camera, dict(jitter or {})
        self.stepped = Stepped(self.world)
        self.flat, self._judge_every_s = observation == "flat", judge_every_s
        model = self.stepped.model
        recorded = self.stepped.recorded_controls()
        self.inputs = control_inputs(model, self.world.plan, self.stepped.indices, recorded, bounds)
        low, high = (np.array([getattr(row, side) for row in self.inputs], float) for side in ("low", "high"))
        self.action_space = gymnasium.spaces.Box(low, high, dtype=np.float64)
        self.actions = -(-self.world.steps // self.stepped.every)
        self.judge: Judge | None = None
        self._episode: Episode | None = None
        if reward:
            rows = self.actions * self.stepped.every // self.stepped.row_every + 2
            meta = {**describe(model, self.world.given.visual_only), "movers": list(self.world.given.movers)}
            self._episode = Episode(model, self.stepped.data, meta, rows)
            known = judge or Judge.of(self.world.plan, self.world.given.duration, self._as_accepted(recorded))
            self.judge = deepcopy(known)
        self.stepped.begin()
        self.stepped.look()
        self.observation_space = space_of(self._observed())
        self._pictures: Any = None
        self._over, self._begun = True, False

    def _as_accepted(self, recorded: np.ndarray) -> Any:
        """The motion by the recorded controls."""
        assert self._episode is not None
        self.stepped.begin()
        self.stepped.look()
        for action in recorded:
            self.stepped.act(action, self._episode)
        self.stepped.end(self._episode)
        return self._episode.motion()

    def reset(self, *, seed: int | None = None, options: dict[str, Any] | None = None) -> tuple[Any, dict[str, Any]]:
        """Stand at the recorded start, off by the jitter that the seed draws."""
        super().reset(seed=seed)
        self._over = True
        self.stepped.begin()
        if jitter := (options or {}).get("jitter", self.jitter):
            shake(self.stepped.model, self.stepped.data, jitter, self.np_random)
        self.stepped.look()
        self._done, self._judged_s, self._over, self._begun = 0, 0.0, False, True
        if self._episode is not None and self.judge is not None:
            self._episode.begin()
            self.judge.begin()
        return self._observed(), self._told()

    def step(self, action: Any) -> tuple[Any, float, bool, bool, dict[str, Any]]:
        """Apply an action, which is kept within its bounds.

        Raises:
            GateError: the episode is over or has not begun, or the action is no (controls,) finite numbers.
        """
        if self._over:
            raise GateError(
                f"the episode {'is over' if self._begun else 'has not begun'}", next_move="call reset() first"
            )
        given = checked(action, (len(self.inputs),))
        space = self.action_space
        assert isinstance(space, gymnasium.spaces.Box)
        self.stepped.act(np.clip(given, space.low, space.high), self._episode)
        self._done += 1
        sick = self.stepped.sick
        truncated = self._done >= self.actions
        reward, broken = 0.0, False
        if self._episode is not None and self.judge is not None and not sick:
            now = float(self.stepped.data.time)
            if truncated:
                self.stepped.end(self._episode)
            if truncated or now - self._judged_s >= self._judge_every_s - 1e-9:
                self._judged_s = now
                reward, broken = self.judge.judge(self._episode, truncated)
        terminated = broken or sick
        self._over = terminated or truncated
        return self._observed(), reward, terminated, truncated and not terminated, self._told()

    def render(self) -> np.ndarray | None:
        """(height, width, 3) uint8: the house's picture through the camera, at the size of the plan's films."""
        if self.render_mode is None:
            return None
        if self._pictures is None:
            from .live_pictures import LivePictures

            self._pictures = LivePictures(self.world, self._camera)
        return np.asarray(self._pictures.draw(self.stepped.data))

    def close(self) -> None:
        """Free what draws."""
        if self._pictures is not None:
            self._pictures.close()
            self._pictures = None

    def _observed(self) -> Any:
        found = columns(self.stepped.model, self.stepped.data)
        return flat(found) if self.flat else found

    def _told(self) -> dict[str, Any]:
        """A new dict each time, so that nobody changes another's."""
        rows = self.judge.rows if self.judge is not None else []
        return {"time_s": float(self.stepped.data.time), "objectives": [row.told() for row in rows]}


def space_of(observed: Any) -> gymnasium.Space:
    """The space of such an observation; nothing bounds a state but the physics."""
    if isinstance(observed, dict):
        return gymnasium.spaces.Dict({name: space_of(values) for name, values in observed.items()})
    return gymnasium.spaces.Box(-np.inf, np.inf, observed.shape, np.float64)
