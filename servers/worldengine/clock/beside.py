"""Run the solvers of one world beside the engine: each step asks them, writes their forces and books their work."""

from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from worldkit.errors import ProgramError
from worldkit.naming import names

from ..inputs.declared_media import Medium
from ..inputs.ports import Ports
from ..inputs.pushes import Pushes
from ..recording.columns import Column
from ..solvers import Row, Shown, called, check

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.record import Recorder
    from ..variants.holding import Hold


class Beside:
    """Steps the solvers of a world.

    In a step: `measure` when velocities are computed, `act` when the inputs have acted, `reacted` when forces are
    computed, `ended` when the step is over; `finish` at the last state.

    Args:
        model, data: the world at its initial state.
        rows: the solvers that the plan asks for, at least one.
        inputs: the author's inputs; no body may be pushed by both.
        hold: the share of the forces that a variant leaves; None leaves all.

    Raises:
        ProgramError: there is no such solver or body, a constant makes no sense, or two would push one body.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        rows: Sequence[Row],
        inputs: Ports | None = None,
        hold: "Hold | None" = None,
    ) -> None:
        import numpy as np

        self._model, self._data, self.rows = model, data, tuple(rows)
        bodies = names(model, "body", model.nbody)
        taken = {entry // 6 for entry in inputs.entries.get("xfrc_applied", ())} if inputs else set()
        self._solvers = []
        self._shown: list[tuple[Medium, Shown]] = []
        self._steps = 0
        self._recorder: Recorder | None = None
        self.channels: dict[Column, np.ndarray] = {}
        for name, row in zip(called(rows), rows, strict=True):
            solver = check(row)
            if unknown := [body for body in row.bodies if body not in bodies[1:]]:
                raise ProgramError(
                    f"the solver {row.solver} acts on {unknown[0]!r}, which is not in the world",
                    "interventions",
                    f"name one of: {', '.join(bodies[1:])}",
                )
            mine = [bodies.index(body) for body in row.bodies]
            pushes = getattr(solver, "PUSHES", True)
            if pushes and (twice := taken.intersection(mine)):
                raise ProgramError(
                    f"{bodies[min(twice)]!r} would be pushed by the solver {row.solver} and by another",
                    "interventions",
                    "let one of them push it: of two forces on one body, nobody could tell whose work is whose",
                )
            taken |= set(mine) if pushes else set()
            running = solver.start(model, data, mine, row.constants, row.shown_by)
            self._solvers.append((np.array(mine, int), running, _shares(mine, hold)))
            if isinstance(running, Shown) and running.points() is not None:
                self._shown.append((Medium(name, row.bodies, row.shown_by), running))
            self.channels |= {_named(name, column): array for column, array in running.channels.items()}
        pushed = frozenset(body for row in rows for body in row.bodies)
        self._ports = Ports(model, (("force", pushed), ("torque", pushed)))
        self._before: list[np.ndarray] = []

    @property
    def shown(self) -> "list[dict[str, Any]]":
        """What of the world they move corner by corner, as rows of a recording's `meta.json`."""
        return [medium.written() for medium, _ in self._shown]

    def record(self, recorder: "Recorder", laws: int = 0) -> None:
        """Keep the ledger of their work in this recording, and the corners that they move, behind those of so many laws; must be
        called before the first step.
        """
        self._recorder, self._first = recorder, laws
        self._pushes = Pushes(self._model, self._data, self._ports, lambda blocks: recorder.later("pushes", blocks))
        recorder.before_flush.append(self._pushes.flush)

    def lay(self, recorder: "Recorder", laws: int = 0) -> None:
        """Keep the corners that they move where they are at the start, and nothing else, behind those of so many laws."""
        self._recorder, self._first = recorder, laws
        self._keep(last=True)

    def measure(self) -> None:
        """Note the velocities, which are computed now."""
        self._pushes.measure()

    def act(self, interfered: bool) -> None:
        """Ask each solver for its forces and write them; `interfered` says that the state was written since `measure`."""
        if interfered:
            self._pushes.interfered()
        applied = self._data.xfrc_applied
        self._before = [applied[bodies].copy() for bodies, _, _ in self._solvers]
        for (bodies, running, shares), before in zip(self._solvers, self._before, strict=True):
            applied[bodies] = before + running.look(self._data) * shares
        self._keep(last=False)
        self._pushes.note()

    def reacted(self) -> None:
        """Note the forces, which are computed now."""
        self._pushes.reacted()

    def ended(self) -> None:
        """End the step: take the forces back, and let each solver advance."""
        step_s = float(self._model.opt.timestep)
        for (bodies, running, _), before in zip(self._solvers, self._before, strict=True):
            self._data.xfrc_applied[bodies] = before
            running.advance(step_s)
        self._steps += 1

    def finish(self) -> None:
        """Bring the channels up to date with the last state, and close the ledger."""
        for _, running, _ in self._solvers:
            running.look(self._data)
        self._keep(last=True)
        self._pushes.measure()
        self._pushes.finish()

    def _keep(self, last: bool) -> None:
        """Record the corners that are due at this step."""
        for number, (_, running) in enumerate(self._shown, self._first):
            due = last or self._steps % running.every == 0
            if due and self._recorder is not None and (points := running.points()) is not None:
                self._recorder.later("media", partial(_corners, self._steps, number, points))


def _named(name: str, column: Column) -> Column:
    return Column(f"{name}.{column.name}", column.shape, column.unit, column.description, column.dtype)


def _corners(step: int, medium: int, points: "np.ndarray") -> dict[str, Any]:
    """The rows of `media` of one instant."""
    import numpy as np

    count = len(points)
    return {
        "step": np.full(count, step, np.int32),
        "medium": np.full(count, medium, np.int32),
        "point": np.arange(count, dtype=np.int32),
        "place": points.astype(np.float32),
        "colour": np.full(count, -1, np.int32),
    }


def _shares(bodies: Sequence[int], hold: "Hold | None") -> "np.ndarray":
    """(n, 6) the share of each force and torque that a variant leaves."""
    import numpy as np

    kept: Mapping[tuple[str, int], float] = hold.inputs if hold else {}
    return np.array([[kept.get(("xfrc_applied", 6 * body + i), 1.0) for i in range(6)] for body in bodies]).reshape(
        -1, 6
    )
