"""Step an accepted world by somebody's controls, exactly as the physics pass steps it.

The rest of what is declared (forces, switches, parameters that the program's `control` wrote) acts as it was recorded, at the
same steps: nobody is there to ask the program. Sent the recorded controls, the world passes through the recorded states, bit for bit.
"""

from typing import TYPE_CHECKING, Any

import numpy as np

from ..model.errors import GateError

if TYPE_CHECKING:
    from worldengine.inputs.strict_stream import Recorded

    from .accepted_world import AcceptedWorld
    from .episode import Episode

BLOW_UPS = ("BADQPOS", "BADQVEL", "BADQACC")
"""The engine's warnings of a number that it gave up on."""


class Stepped:
    """One world that is stepped.

    Args:
        world: the accepted world; the model is its own, so only one of several `Stepped` may change parameters of it.

    Attributes:
        indices: of `ctrl`, the declared controls: an action has so many numbers.
        others: how many entries and parameters beside them act as they were recorded.
        every: steps from one action to the next.
        row_every: steps from one row of an episode to the next, as the recording of so long a world has them.

    Raises:
        GateError: an author's law or a solver beside the engine belongs to the world.
    """

    def __init__(self, world: "AcceptedWorld") -> None:
        import copy

        import mujoco

        from worldengine.inputs.ports import Ports
        from worldengine.inputs.replies import Answers
        from worldkit.world import record_every, start

        if world.given.laws or world.given.solvers:
            rows: tuple[Any, ...] = (*world.given.laws, *world.given.solvers)
            beside = ", ".join(str(getattr(row, "name", "") or row.solver) for row in rows)
            raise GateError(
                f"plain MuJoCo does not step this world: {beside} works beside the engine",
                place=str(world.folder),
                next_move="take a world without `kind: solver` in its interventions",
            )
        self.model = copy.copy(world.model)
        self.data = start(self.model)
        self.every, self.row_every = world.given.control_every, record_every(self.model, world.steps)
        self._world, self._as_built = world, copy.copy(world.model)
        self._ports = Ports(self.model, world.given.inputs if world.given.answers else ())
        self.indices = tuple(self._ports.entries.get("ctrl", ()))
        self.others = self._ports.width - len(self.indices) + len(self._ports.parameters)
        self.key = mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_KEY, "start")
        self._rk4 = self.model.opt.integrator == mujoco.mjtIntegrator.mjINT_RK4
        self._answers = Answers(self.model, self.data, self._ports)
        self._recorded: Recorded | None = None
        self.step_number = 0

    def recorded_controls(self) -> np.ndarray:
        """(questions, controls) what the declared controls were in the accepted recording, one row an action."""
        recorded = self._world.recorded(self._ports)
        rows = []
        for step in range(0, self._world.steps, self.every):
            if recorded.speaks(step):
                recorded.answer(step)
            rows.append(recorded.vector[: len(self.indices)].copy())
        return np.array(rows).reshape(len(rows), len(self.indices))

    def begin(self) -> None:
        """Stand at the start, as recorded, with the model as it was built."""
        import mujoco

        if self.others:  # parameters may have been edited
            for name, _ in self._ports.parameters:
                _restore(self.model, self._as_built, name)
        if self.key >= 0:
            mujoco.mj_resetDataKeyframe(self.model, self.data, self.key)
        else:
            mujoco.mj_resetData(self.model, self.data)
        self._recorded = self._world.recorded(self._ports) if self.others else None
        self.step_number = 0

    def look(self) -> None:
        """Compute what derives from positions and velocities; call it after `begin`, and after a change of the start."""
        import mujoco

        mujoco.mj_step1(self.model, self.data)

    def act(self, action: np.ndarray, episode: "Episode | None" = None) -> None:
        """Apply a (controls,) action, take the steps up to the next one, and compute what derives from the new state.

        None is taken beyond the plan's duration: where `every` does not divide its steps, the last action acts for fewer.
        """
        import mujoco

        for number in range(min(self.every, self._world.steps - self.step_number)):
            if number == 0:
                self._write(action)
            kept = episode if self.step_number % self.row_every == 0 else None
            if kept is not None:
                kept.before()
            if self._rk4:
                mujoco.mj_forwardSkip(self.model, self.data, int(mujoco.mjtStage.mjSTAGE_VEL), 0)
            else:
                mujoco.mj_step2(self.model, self.data)
            if kept is not None:
                kept.after()
            if self._rk4:
                mujoco.mj_step(self.model, self.data)
            self.step_number += 1
            mujoco.mj_step1(self.model, self.data)

    def end(self, episode: "Episode | None") -> None:
        """Add the row of the last state, whose forces no step computes."""
        import mujoco

        mujoco.mj_forward(self.model, self.data)
        if episode is not None:
            episode.before()
            episode.after()

    @property
    def sick(self) -> bool:
        """Whether the engine gave up on a number since the episode began: a position, velocity or acceleration."""
        import mujoco

        return any(self.data.warning.number[int(getattr(mujoco.mjtWarning, f"mjWARN_{kind}"))] for kind in BLOW_UPS)

    def _write(self, action: np.ndarray) -> None:
        if self._recorded is None:
            self.data.ctrl[list(self.indices)] = action
            return
        from worldengine.inputs.ledger import refresh

        answers, step = self._answers, self.step_number
        vector, edits = self._recorded.answer(step)
        vector = vector.copy()
        vector[: len(self.indices)] = action
        answers.replay(vector, edits)
        answers.push()
        answers.edit()
        if answers.changes:
            answers.change()
            refresh(self.model, self.data)


def _restore(model: Any, built: Any, name: str) -> None:
    """Give an array or option of the model its built value."""
    owner, source, last = model, built, name
    if name.startswith("opt."):
        owner, source, last = model.opt, built.opt, name.removeprefix("opt.")
    value = getattr(source, last)
    if isinstance(value, np.ndarray):
        getattr(owner, last)[...] = value
    else:
        setattr(owner, last, value)
