"""Many copies of an accepted world as one vectorised Gymnasium environment, over MuJoCo's batch where it carries the world.

The batch (`mujoco.batch.Batch`) steps all copies on threads, and each passes through the very states that it would alone. It
carries a world on which nothing acts but the controls, of which nothing sleeps, and without rewards: an expectation asks for the
contacts of every step, and a batch keeps none. Every other world gets one environment after the other (`SyncVectorEnv`).
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import gymnasium
import numpy as np
from gymnasium.vector import AutoresetMode, SyncVectorEnv, VectorEnv
from gymnasium.vector.utils import batch_space

from ..model.errors import GateError
from .gymnasium_world import World
from .jitter import Jitter, shake
from .observations import NEEDED, columns, flat


def worlds(num_envs: int, run: Path | str, threads: int = 0, **words: Any) -> VectorEnv:
    """So many copies of a world; `words` are those of `World`, and `threads` is for the batch, 0 for all cores."""
    if not words.get("reward", True) and not words.get("render_mode"):
        one = World(run, **words)
        if carried(one):
            return BatchedWorlds(one, num_envs, threads)
    return SyncVectorEnv([lambda: World(run, **words) for _ in range(num_envs)])


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

    def reset(
        self, *, seed: int | list[int | None] | None = None, options: dict[str, Any] | None = None
    ) -> tuple[Any, dict[str, Any]]:
        """Let all copies stand at the start; copy k draws its jitter by seed + k, or by the k-th seed."""
        seeds = seed if isinstance(seed, list) else [None if seed is None else seed + k for k in range(self.num_envs)]
        if seed is not None or not hasattr(self, "_rngs"):
            self._rngs = [
                np.random.default_rng(own) if own is None else gymnasium.utils.seeding.np_random(own)[0]
                for own in seeds
            ]
        self._jitter: Jitter = (options or {}).get("jitter", self._one.jitter)
        self._begin(np.arange(self.num_envs))
        return self._observed(), {}

    def step(self, actions: Any) -> tuple[Any, np.ndarray, np.ndarray, np.ndarray, dict[str, Any]]:
        """Apply (num_envs, controls) actions, each kept within its bounds; rewards are 0.

        Raises:
            GateError: a number is not finite.
        """
        given = np.asarray(actions, float).reshape(self.num_envs, -1)
        if not np.isfinite(given).all():
            raise GateError("an action holds a number that is not finite", next_move="see env.unwrapped.inputs")
        space = self.single_action_space
        assert isinstance(space, gymnasium.spaces.Box)
        ended = np.flatnonzero(self._over)
        going = np.flatnonzero(~self._over)
        self._ctrl[:, list(self._one.stepped.indices)] = np.clip(given, space.low, space.high)
        if len(going):
            self._batch.step(going, nstep=self._one.stepped.every, stage=self._velocities)
        self._done[going] += 1
        if len(ended):
            self._begin(ended)
        sick = ~np.isfinite(self._data.qvel).all(axis=1)
        truncated = (self._done >= self._one.actions) & ~sick
        self._over = sick | truncated
        return self._observed(), np.zeros(self.num_envs), sick, truncated, {}

    def close_extras(self, **_: Any) -> None:
        """Free what the single environment holds."""
        self._one.close()

    def _begin(self, ids: np.ndarray) -> None:
        """Let these copies stand at the start."""
        import mujoco

        stepped = self._one.stepped
        self._batch.reset(ids, keyframe=stepped.key, stage=int(mujoco.mjtStage.mjSTAGE_NONE))
        for copy in ids if self._jitter else ():
            stepped.begin()
            shake(self._model, stepped.data, self._jitter, self._rngs[copy])
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
