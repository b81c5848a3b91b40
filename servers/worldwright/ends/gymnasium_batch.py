"""Many copies of an accepted world as one vectorised Gymnasium environment, over MuJoCo's batch where it carries the world.

The batch (`mujoco.batch.Batch`) steps all copies on threads, and each passes through the very states that it would alone. It
carries a world on which nothing acts but the controls, of which nothing sleeps, and without rewards: an expectation asks for the
contacts of every step, and a batch keeps none. Every other world gets one environment after the other (`SyncVectorEnv`), which
share what is judged.
"""

from collections.abc import Callable, Mapping
from functools import partial
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space

from worldengine.clock.simulate import HUGE

from ..model.errors import GateError
from .controls import checked
from .gymnasium_world import World
from .jitter import Jitter, shake
from .observations import NEEDED, columns, flat
from .stepping import BLOW_UPS

NUMBER = 1
"""Of a warning in the batch's table: how often it was given."""


def worlds(num_envs: int, run: Path | str, threads: int = 0, **words: Any) -> VectorEnv:
    """So many copies of a world; `words` are those of `World`, and `threads` is for the batch, 0 for all cores."""
    one = World(run, **words)
    if carried(one) and one.render_mode is None:
        return BatchedWorlds(one, num_envs, threads)
    makers: list[Callable[[], gymnasium.Env]] = [lambda: one]
    makers += [partial(World, run, **{**words, "judge": one.judge})] * (num_envs - 1)
    return SyncVectorEnv(makers)


def carried(world: World) -> bool:
    """Whether a batch does with this world what the physics pass does."""
    import mujoco

    model = world.stepped.model
    sleeps = bool(model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_SLEEP))
    return world.judge is None and not world.stepped.others and not sleeps and not model.nplugin


class BatchedWorlds(VectorEnv):
    """Copies of one world in a batch; an ended copy begins anew at the next step, whose action it does not hear.

    Args:
        one: the world, as a single environment; its jitter and its spaces are those of all.
        num_envs: how many.
        threads: of the batch; 0 for all cores.
    """

    def __init__(self, one: World, num_envs: int, threads: int = 0) -> None:
        import mujoco
        from mujoco.batch import Batch

        self._bad = [int(getattr(mujoco.mjtWarning, f"mjWARN_{kind}")) for kind in BLOW_UPS]
        self.metadata = {**one.metadata, "autoreset_mode": AutoresetMode.NEXT_STEP}
        self.num_envs, self._one = num_envs, one
        self.inputs = one.inputs
        self.single_action_space, self.single_observation_space = one.action_space, one.observation_space
        self.action_space = batch_space(one.action_space, num_envs)
        self.observation_space = batch_space(one.observation_space, num_envs)
        self._model = one.stepped.model
        self._batch = Batch(self._model, num_envs, threads)
        self._data = _Bound({name: self._batch.bind(name) for name in NEEDED})
        self._ctrl = self._batch.bind("ctrl")
        self._velocities = int(mujoco.mjtStage.mjSTAGE_VEL)
        self._done = np.zeros(num_envs, int)
        self._over = np.zeros(num_envs, bool)
        self._begun = False

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Let all copies stand at the start; copy k draws its jitter by seed + k, or by the k-th seed.

        A jitter of the options is that of these episodes alone.

        Raises:
            GateError: so many seeds are not wanted, or an amount of the jitter is not finite.
            NotFoundError: nothing has the jitter's name.
        """
        seeds = seed if isinstance(seed, list) else [None if seed is None else seed + k for k in range(self.num_envs)]
        if len(seeds) != self.num_envs:
            raise GateError(
                f"{len(seeds)} seeds for {self.num_envs} copies", next_move="give one number, or one a copy"
            )
        if seed is not None or not hasattr(self, "_rngs"):
            self._rngs = [
                np.random.default_rng(own) if own is None else gymnasium.utils.seeding.np_random(own)[0]
                for own in seeds
            ]
        self._begun = False
        self._begin(np.arange(self.num_envs), (options or {}).get("jitter", self._one.jitter))
        self._begun = True
        return self._observed(), {}

    def step(self, actions: Any) -> tuple[Any, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """Apply (num_envs, controls) actions, each kept within its bounds; rewards are 0.

        Raises:
            GateError: nothing has begun, or the actions are no (num_envs, controls) finite numbers.
        """
        if not self._begun:
            raise GateError("no episode has begun", next_move="call reset() first")
        stepped = self._one.stepped
        given = checked(actions, (self.num_envs, len(self.inputs)))
        space = self.single_action_space
        assert isinstance(space, gymnasium.spaces.Box)
        ended = np.flatnonzero(self._over)
        going = np.flatnonzero(~self._over)
        self._ctrl[:, list(stepped.indices)] = np.clip(given, space.low, space.high)
        left = np.minimum(stepped.every, self._one.world.steps - self._done[going] * stepped.every)
        for steps in np.unique(left):
            self._batch.step(going[left == steps], nstep=int(steps), stage=self._velocities)
        self._done[going] += 1
        if len(ended):
            self._begin(ended, self._one.jitter)
        sick = ~self._sane()
        truncated = (self._done >= self._one.actions) & ~sick
        self._over = sick | truncated
        return self._observed(), np.zeros(self.num_envs), sick, truncated, {}

    def close_extras(self, **_: Any) -> None:
        """Free what the single environment holds."""
        self._one.close()

    def _sane(self) -> np.ndarray:
        """(num_envs,) whether nothing of a copy blew up since it began: by its numbers now, and by the engine's warnings."""
        now = [(np.abs(getattr(self._data, name)) < HUGE).all(axis=1) for name in ("qpos", "qvel")]
        return np.logical_and.reduce([*now, (self._batch.warning[:, self._bad, NUMBER] == 0).all(axis=1)])

    def _begin(self, ids: np.ndarray, jitter: Jitter | None) -> None:
        """Let these copies stand at the start."""
        import mujoco

        stepped = self._one.stepped
        self._batch.reset(ids, keyframe=stepped.key, stage=int(mujoco.mjtStage.mjSTAGE_NONE))
        for copy in ids if jitter else ():
            assert jitter
            stepped.begin()
            shake(self._model, stepped.data, jitter, self._rngs[copy])
            self._data.qpos[copy], self._data.qvel[copy] = stepped.data.qpos, stepped.data.qvel
        self._batch.forward(ids, stage=self._velocities)
        self._done[ids] = 0
        self._over[ids] = False

    def _observed(self) -> Any:
        found = columns(self._model, self._data)
        return flat(found, 1) if self._one.flat else found


class _Bound:
    """The batch's live arrays as attributes, (num_envs, …) each."""

    def __init__(self, arrays: Mapping[str, np.ndarray]) -> None:
        self.__dict__.update(arrays)

    def __getattr__(self, name: str) -> np.ndarray:
        raise AttributeError(name)
