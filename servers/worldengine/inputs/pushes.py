"""Note what pushes during a step: forces and torques on bodies and joints, controls of actuators (`push_works`).

A step's inputs and the velocities at its two ends are noted while it happens, one copy of a few numbers each, and only while
there are inputs other than zero: a world may declare many that rest. Everything is worked out later, beside the steps, for as many at once
as stay near the processor: reading them again from further away costs more than what is done with them.
"""

import queue
from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from worldkit.mirror import Mirror, address, differ, memory

from ..recording.push_blocks import Block
from .even_copies import reader
from .push_works import Way, ways

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .ports import Ports

ROWS = 1024
MOST_BYTES = 16 << 20
NEAR_BYTES = 1 << 19
"""Notes of about so many bytes are worked out at once."""


class Pushes:
    """Notes of consecutive steps; `emit` receives functions that make blocks of the ledger of them (`push_blocks`).

    A step goes: `measure()` when velocities are computed, `interfered()` if the state was then written, `note()` once the
    inputs in force are known, `reacted()` once forces are. `measure()` and `finish()` once more at the end of the run.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: "Ports",
        emit: Callable[[Callable[[], "Iterator[Block]"]], object],
    ) -> None:
        import numpy as np

        self._data, self._emit = data, emit
        numbers, _ = Mirror(model, data, sends=False).numbers({}, ())
        found = ways(model, data, ports)
        row = 8 * (1 + sum(len(way.inputs) + len(way.speeds) + len(way.forces) for way in found))
        self._capacity = max(16, min(ROWS, MOST_BYTES // row))
        self._time = np.zeros(self._capacity + 1)
        self._notes = [_Notes(way, data, numbers, self._capacity) for way in found]
        self._forced = [notes for notes in self._notes if notes.forced]
        self._acting = [notes for notes in self._notes if notes.acting]
        self._count = 0

    def measure(self) -> None:
        """Note the velocities, which are computed now."""
        n = self._count
        self._time[n] = self._data.time
        for notes in self._acting:
            notes.measure(n)

    def interfered(self) -> None:
        """Note that the state was written and what derives from it computed anew."""
        for notes in self._acting:
            notes.interfered(self._count)

    def note(self) -> None:
        """Note the inputs that act during the step."""
        n, before = self._count, self._acting
        self._acting = [notes for notes in self._notes if notes.note(n, notes in before)]

    def reacted(self) -> None:
        """Note the forces, which are computed now, before the step ends."""
        for notes in self._forced:
            notes.reacted(self._count)
        self._count += 1
        if self._count == self._capacity:
            self.flush()

    def flush(self) -> None:
        """Hand over all steps whose end is known, which are all but the last."""
        if self._count > 1:
            self._hand_over(self._count - 1)

    def finish(self) -> None:
        """Hand over the rest, once the velocities at the end are measured."""
        if self._count:
            self._hand_over(self._count)

    def _hand_over(self, steps: int) -> None:
        time, last = self._time.copy(), self._count + 1
        made = [pair for notes in self._notes if (pair := notes.hand_over(time[: steps + 1], steps, last))]
        if made:
            self._emit(lambda: _each(made))
        self._time[: last - steps] = time[steps:last]
        self._count -= steps


def _each(made: "list[tuple[Callable[[], Block], Callable[[], object]]]") -> "Iterator[Block]":
    """Each block; once it is used, the memory of its notes is, too."""
    for block, give_back in made:
        yield block()
        give_back()


class _Notes:
    """Notes of one way to push: row n of each array is of the step n."""

    def __init__(self, way: Way, data: "mujoco.MjData", numbers: "np.ndarray", capacity: int) -> None:
        import numpy as np

        self._way, self._rows = way, capacity + 1
        (pushes, self._push), (speeds, self._move), (forces, self._force) = (
            reader(numbers, index) for index in (way.inputs, way.speeds, way.forces)
        )
        targets = len(way.targets)
        told = () if way.plain else (way.width, targets)
        self._shapes = ((), pushes, speeds, forces, told, (targets,))
        self._near = max(1, NEAR_BYTES // (8 * (len(way.inputs) + 2 * len(way.speeds) + len(way.forces))))
        self._first = memory(address(numbers) + 8 * int(way.inputs[0]), 8).cast("d")
        """The first of the inputs: while that pushes, nobody looks for others."""
        looked = getattr(data, way.array) if way.array else np.zeros(0)
        self._looked, self._at, self._rest = looked, address(looked), looked.nbytes - looked.itemsize
        self.acting, self.forced = not way.array, len(way.forces) > 0
        self._before = numbers.take(way.inputs)
        self._free: queue.SimpleQueue[list[np.ndarray]] = queue.SimpleQueue()
        self._ends: dict[int, np.ndarray] = {}
        """Velocities at the end of those steps after which the state was written."""
        self._begin()

    def _begin(self) -> None:
        """Begin new notes, in memory that was given back if there is any: fresh pages cost as much as what is done with them."""
        import numpy as np

        try:
            self._all = self._free.get_nowait()
        except queue.Empty:
            self._all = [np.zeros((self._rows, *shape)) for shape in self._shapes]
        self._acts, self._pushed, self._speed, self._exerted = self._all[:4]
        self._acts[:] = 0.0

    def measure(self, n: int) -> None:
        """Note the velocities, at the end of a step in which this pushed and at the beginning of the next."""
        self._move(self._speed[n])

    def interfered(self, n: int) -> None:
        """Note them anew for this step."""
        if n:
            self._ends[n - 1] = self._speed[n].copy()
        self.measure(n)

    def note(self, n: int, known: bool) -> bool:
        """Note the inputs, and the velocities if they are not known; returns whether there are inputs."""
        if len(self._looked):  # zero are all numbers if one is, and each is as the next
            self.acting = (
                self._first[0] != 0 or differ(self._at, self._at + 8, self._rest) != 0 or self._looked.flat[0] != 0
            )
        if self.acting:
            self._acts[n] = 1.0
            self._push(self._pushed[n])
            if not known:
                self.measure(n)
        return self.acting

    def reacted(self, n: int) -> None:
        """Note the forces."""
        self._force(self._exerted[n])

    def hand_over(
        self, time: "np.ndarray", steps: int, last: int
    ) -> "tuple[Callable[[], Block], Callable[[], object]] | None":
        """Begin new notes after so many steps, with what is noted until the row `last`.

        Returns what makes a block of the old ones, and what must be called once it is used; None where nothing pushed in them.
        """
        old, ends, before = self._all, self._ends, self._before
        acts, pushed, speed, exerted, told, works = (rows[:steps] for rows in old)
        self._begin()
        self._ends = {step - steps: kept for step, kept in ends.items() if step >= steps}
        for new, rows in zip(self._all[:4], old[:4], strict=True):
            new[: last - steps] = rows[steps:last]
        give_back = lambda: self._free.put(old)  # noqa: E731
        if not acts.any():
            give_back()
            return None
        if not acts.all():
            pushed[acts == 0] = 0.0
        self._before = pushed[-1].reshape(-1).copy()
        end = old[2][1 : steps + 1]
        if ends:
            end = end.copy()
            for step, kept in ends.items():
                if step < steps:
                    end[step] = kept
        noted = [rows.reshape(steps, -1) for rows in (pushed, speed, end, exerted)]
        numbers = noted[0].reshape(steps, self._way.width, -1) if self._way.plain else told
        return lambda: self._work_out(time, noted, before, numbers, works), give_back

    def _work_out(
        self,
        time: "np.ndarray",
        noted: "list[np.ndarray]",
        before: "np.ndarray",
        numbers: "np.ndarray",
        works: "np.ndarray",
    ) -> Block:
        """Tell steps of (S + 1,) times, some at once."""
        import numpy as np

        way, acts = self._way, np.empty(works.shape, bool)
        for first in range(0, len(works), self._near):
            near = slice(first, first + self._near)
            former = noted[0][first - 1] if first else before
            way.told(
                time[first : first + self._near + 1], *(rows[near] for rows in noted), former,
                acts[near], numbers[near], works[near],
            )  # fmt: skip
        return Block(way.kind, time[:-1], way.targets, acts, numbers, works)


def twist(model: "mujoco.MjModel", data: "mujoco.MjData", body: int) -> "np.ndarray":
    """(6,) m/s and rad/s: velocity of a body's centre of mass and its angular velocity, world frame."""
    import numpy as np

    spin, linear = data.cvel[body, :3], data.cvel[body, 3:]
    arm = data.xipos[body] - data.subtree_com[model.body_rootid[body]]
    return np.concatenate((linear + np.cross(spin, arm), spin))


def displacement(data: "mujoco.MjData", body: int, pos: "np.ndarray", quat: "np.ndarray") -> "np.ndarray":
    """(6,) translation of a body's origin, m, and rotation vector, rad, from `pos` (3,), `quat` (4,) to its present pose."""
    import numpy as np

    from worldkit.turning import conjugate, product, rotation_vectors

    return np.concatenate((data.xpos[body] - pos, rotation_vectors(product(data.xquat[body], conjugate(quat)))))
