"""Note what pushes during a step: forces and torques on bodies and joints, controls of actuators (`push_works`).

A step's inputs and the velocities at its two ends are noted while it happens, one copy of a few numbers each, and only while
there are inputs other than zero: a world may declare many that rest. The work is worked out for many steps at once: as many as
stay in the processor's memory, since reading them again from further away costs more than what is done with them. Blocks of the
ledger are many of these, and are written beside the steps.
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
"""Blocks of one time are at most as large, and have at most so many rows."""
NEAR_BYTES = 1 << 19
"""Notes of so many bytes are worked out at once, and of at least `FEWEST` steps."""
FEWEST = 16


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
        noted = sum(len(way.inputs) + len(way.speeds) + len(way.forces) for way in found)
        told = sum(len(way.targets) * (way.width + 1) for way in found)
        self._near = max(FEWEST, min(ROWS, NEAR_BYTES // (8 * noted + 8)))
        self._capacity = max(self._near, min(ROWS, MOST_BYTES // (8 * told + 8)))
        self._time = np.zeros(self._near + 1)
        self._times = np.zeros(self._capacity)
        self._notes = [_Notes(way, data, numbers, self._near, self._capacity) for way in found]
        self._forced = [notes for notes in self._notes if notes.forced]
        self._acting = [notes for notes in self._notes if notes.acting]
        self._count = self._done = 0
        """Steps that are noted, and before them steps that are worked out."""

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
        if self._count == self._near:
            self._work_out(self._near - 1)
            if self._done + self._near > self._capacity:
                self._hand_over()

    def flush(self) -> None:
        """Hand over all steps whose end is known, which are all but the last."""
        if self._count > 1:
            self._work_out(self._count - 1)
        self._hand_over()

    def finish(self) -> None:
        """Hand over the rest, once the velocities at the end are measured."""
        if self._count:
            self._work_out(self._count)
        self._hand_over()

    def _work_out(self, steps: int) -> None:
        """Work out the first so many of the noted steps, whose ends are known."""
        time, last, done = self._time, self._count + 1, self._done
        for notes in self._notes:
            notes.work_out(time[: steps + 1], steps, last)
        self._times[done : done + steps] = time[:steps]
        time[: last - steps] = time[steps:last].copy()
        self._count, self._done = self._count - steps, done + steps

    def _hand_over(self) -> None:
        """Hand over what is worked out."""
        if not self._done:
            return
        time, rest = self._times[: self._done].copy(), self._count + 1
        made = [pair for notes in self._notes if (pair := notes.hand_over(time, rest))]
        if made:
            self._emit(lambda: _each(made))
        self._done = 0


def _each(made: "list[tuple[Block, Callable[[], object]]]") -> "Iterator[Block]":
    """Each block; once it is used, the memory of its notes is, too."""
    for block, give_back in made:
        yield block
        give_back()


class _Notes:
    """Notes of one way to push: row n of each array is of the step n, and rows of the block come before them."""

    def __init__(self, way: Way, data: "mujoco.MjData", numbers: "np.ndarray", near: int, capacity: int) -> None:
        import numpy as np

        self._way, self._near, self._capacity = way, near, capacity
        looked = getattr(data, way.array) if way.array else np.zeros(0)
        self._looked, self._at, self._rest = looked, address(looked), looked.nbytes - looked.itemsize
        self._first = memory(address(numbers) + 8 * int(way.inputs[0]), 8).cast("d")
        """The first of the inputs: while that pushes, nobody looks for others."""
        self.acting, self.forced = not way.array, len(way.forces) > 0
        self._before = numbers.take(way.inputs)
        (pushes, self._push), (speeds, self._move), (forces, self._force) = (
            reader(numbers, index) for index in (way.inputs, way.speeds, way.forces)
        )
        self._shape = pushes
        self._acts = np.zeros(near + 1)
        self._speed, self._exerted = np.zeros((near + 1, *speeds)), np.zeros((near + 1, *forces))
        self._own = None if way.plain else np.zeros((near + 1, *pushes))
        self._ends: dict[int, np.ndarray] = {}
        """Velocities at the end of those steps after which the state was written."""
        self._free: queue.SimpleQueue[list[np.ndarray]] = queue.SimpleQueue()
        self._begin()

    def _begin(self) -> None:
        """Begin a new block, in memory that was given back if there is any: fresh pages cost as much as what is done with them."""
        import numpy as np

        targets = len(self._way.targets)
        try:
            self._block = self._free.get_nowait()
        except queue.Empty:
            rows = self._capacity + 1
            widths = ((self._way.width, targets), (targets,))
            self._block = [np.zeros((rows, targets), bool), *(np.zeros((rows, *width)) for width in widths)]
        self._done, self._told = 0, False
        self._place()

    def _place(self) -> None:
        """Let the next steps' inputs be noted behind what is worked out, where the block tells them as they are."""
        plain = self._block[1].reshape(-1, *self._shape)[self._done :] if self._own is None else self._own
        self._pushed = plain

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

    def work_out(self, time: "np.ndarray", steps: int, last: int) -> None:
        """Work out so many steps, of (steps + 1,) times, into the block; what is noted behind them, until the row `last`, is kept."""
        acts, ends, rows = self._acts[:steps], self._ends, slice(self._done, self._done + steps)
        found = [part[rows] for part in self._block]
        if acts.any():
            pushed = self._pushed[:steps]
            if not acts.all():
                pushed[acts == 0] = 0.0
            end = self._speed[1 : steps + 1]
            if ends:
                end = end.copy()
                for step, kept in ends.items():
                    if step < steps:
                        end[step] = kept
            speed, exerted = self._speed[:steps].reshape(steps, -1), self._exerted[:steps].reshape(steps, -1)
            flat = pushed.reshape(steps, -1)
            self._way.told(time, flat, speed, end.reshape(steps, -1), exerted, self._before, *found)
            self._before, self._told = flat[-1].copy(), True
        else:
            found[0][:] = False
        self._ends = {step - steps: kept for step, kept in ends.items() if step >= steps}
        self._done += steps
        for part in (self._acts, self._speed, self._exerted, *(() if self._own is None else (self._own,))):
            part[: last - steps] = part[steps:last].copy()
        self._acts[last - steps :] = 0.0
        self._place()

    def hand_over(self, time: "np.ndarray", rest: int) -> "tuple[Block, Callable[[], object]] | None":
        """Begin a new block, with so many rows that are noted and not worked out.

        Returns the old one, and what must be called once it is used; None where nothing pushed in it.
        """
        old, told, done, way = self._block, self._told, self._done, self._way
        noted = self._pushed[:rest]
        self._begin()
        if self._own is None:
            self._pushed[:rest] = noted
        give_back = lambda: self._free.put(old)  # noqa: E731
        if not told:
            give_back()
            return None
        acts, numbers, works = (part[:done] for part in old)
        return Block(way.kind, time, way.targets, acts, numbers, works), give_back


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
