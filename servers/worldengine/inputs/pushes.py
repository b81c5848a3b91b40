"""Note what pushes during a step, and the work it does: forces and torques on bodies and joints, controls of actuators.

The work of a force that is constant over a step is that force times the mean of the velocities at both ends, times the step:
exactly the kinetic energy that it hands to a body of constant mass. So a step's inputs and velocities are noted while it
happens, one copy of a few numbers each, and everything is worked out later for a thousand steps at once.
"""

from collections.abc import Callable, Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from worldkit.mirror import Mirror
from worldkit.naming import names

from ..recording.coded_words import Words
from ..recording.columns import VALUES
from ..recording.describing import actuator_columns, pulled_bodies
from .force_outputs import outputs

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .ports import Ports

ROWS = 1024
MOST_BYTES = 4 << 20
FREE, BALL, SLIDE, HINGE = range(4)
"""mjtJoint."""
WRENCH = {"force": slice(0, 3), "torque": slice(3, 6)}
"""Parts of a row's values, by its kind."""
Columns = dict[str, Any]
"""Columns of the interventions table, by name."""


class Pushes:
    """Notes of consecutive steps; `emit` receives a function that turns them into rows of the ledger.

    A step goes: `measure()` when velocities are computed, `interfered()` if the state was then written, `note()` once the
    inputs in force are known, `reacted()` once forces are. `measure()` and `finish()` once more at the end of the run.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: "Ports",
        emit: Callable[[Callable[[], Columns]], object],
    ) -> None:
        import numpy as np

        self._data, self._emit = data, emit
        self._book = _Book(model, data, ports)
        self._numbers, self._inputs, self._speeds, self._forces = self._book.indices
        row = 8 * (len(self._inputs) + len(self._speeds) + len(self._forces) + 1)
        self._capacity = max(16, min(ROWS, MOST_BYTES // row))
        self._last_controls = np.array(data.ctrl[self._book.controls])
        widths = ((), (len(self._inputs),), (len(self._speeds),), (len(self._forces),))
        self._notes = [np.zeros((0, *width)) for width in widths]
        self._time, self._pushed, self._speed, self._exerted = self._notes
        self._count = 0
        self._ends: dict[int, np.ndarray] = {}
        """Velocities at the end of those steps after which the state was written."""
        self._start(0)

    def _start(self, kept: int) -> None:
        """Begin new notes with the last `kept` steps of the old ones and the notes of the step under way."""
        import numpy as np

        fresh = [np.zeros((self._capacity + 1, *note.shape[1:])) for note in self._notes]
        for new, old in zip(fresh, self._notes, strict=True):
            last = old[self._count - kept : self._count + 1]
            new[: len(last)] = last
        self._notes = fresh
        self._time, self._pushed, self._speed, self._exerted = fresh
        self._count = kept
        self._ends.clear()

    def measure(self) -> None:
        """Note the velocities, which are computed now."""
        n = self._count
        self._time[n] = self._data.time
        self._numbers.take(self._speeds, out=self._speed[n], mode="clip")

    def interfered(self) -> None:
        """Note that the state was written and what derives from it computed anew."""
        n = self._count
        if n:
            self._ends[n - 1] = self._speed[n].copy()
        self._numbers.take(self._speeds, out=self._speed[n], mode="clip")

    def note(self) -> None:
        """Note the inputs that act during the step."""
        self._numbers.take(self._inputs, out=self._pushed[self._count], mode="clip")

    def reacted(self) -> None:
        """Note the forces, which are computed now, before the step ends."""
        if len(self._forces):
            self._numbers.take(self._forces, out=self._exerted[self._count], mode="clip")
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
        book, before = self._book, self._last_controls
        time, pushed = self._time[: steps + 1], self._pushed[:steps]
        begin, end, exerted = self._speed[:steps], self._speed[1 : steps + 1].copy(), self._exerted[:steps]
        for step, speed in self._ends.items():
            if step < steps:
                end[step] = speed
        self._last_controls = pushed[-1, : len(book.controls)].copy()
        if pushed.any() or before.any():
            self._emit(lambda: book.rows(time, pushed, begin, end, exerted, before))
        self._start(self._count - steps)


class _Book:
    """Knows where in the data the inputs, velocities and forces are, and makes rows of them."""

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: "Ports") -> None:
        import numpy as np

        self._model = model
        bodies, joints = names(model, "body", model.nbody), names(model, "joint", model.njnt)
        self.controls = np.array(ports.entries.get("ctrl", ()), np.intp)
        self._bodies = np.unique(np.array(ports.entries.get("xfrc_applied", ()), np.intp) // 6)
        dofs = np.array(ports.entries.get("qfrc_applied", ()), np.intp)
        self._joints = np.unique(model.dof_jntid[dofs]) if len(dofs) else np.zeros(0, np.intp)
        self._dofs = {int(j): _dofs(model, int(j)) for j in self._joints}
        self._by_kind = _alike(model.jnt_type[self._joints])
        pulled, columns = pulled_bodies(model)["actuator"], actuator_columns(model)[0]
        output = outputs(model)
        self._actuators = [  # an actuator that moves one body's joint is called `body/actuator`
            f"{pulled[output[c]][0]}/{columns[c]}" if len(pulled[output[c]]) == 1 else columns[c]
            for c in self.controls.tolist()
        ]
        self._called = [bodies[b] for b in self._bodies]
        owner = [int(model.jnt_bodyid[j]) for j in self._joints]
        self._owners = [
            bodies[b] if model.body_jntnum[b] == 1 else f"{bodies[b]}/{joints[j]}"
            for b, j in zip(owner, self._joints, strict=True)
        ]
        mirror = Mirror(model, data)
        self._parts: dict[str, slice] = {}

        def lay(rows: list[tuple[str, str, Any]]) -> Any:
            index: list[Any] = []
            for name, array, flat in rows:
                start = sum(map(len, index))
                index.append(mirror.at(array) // 8 + np.asarray(flat, np.intp).reshape(-1))
                self._parts[name] = slice(start, start + len(index[-1]))
            return np.concatenate(index) if index else np.zeros(0, np.intp)

        def each(items: Any, width: int) -> Any:
            return (np.asarray(items, np.intp)[:, None] * width + np.arange(width)).reshape(-1)

        all_dofs = np.concatenate([np.zeros(0, np.intp), *(np.arange(s.start, s.stop) for s in self._dofs.values())])
        pushed = [
            ("ctrl", "ctrl", self.controls),
            ("qfrc", "qfrc_applied", all_dofs),
            ("xfrc", "xfrc_applied", each(self._bodies, 6)),
        ]
        speeds = [
            ("drive", "actuator_velocity", output[self.controls] if len(self.controls) else ()),
            ("qvel", "qvel", all_dofs),
            ("cvel", "cvel", each(self._bodies, 6)),
            ("centre", "xipos", each(self._bodies, 3)),
            ("tree", "subtree_com", each(model.body_rootid[self._bodies], 3)),
            ("turned", "xmat", each(owner, 9)),
            ("axis", "xaxis", each(self._joints, 3)),
        ]
        forces = [("exerted", "actuator_force", output[self.controls] if len(self.controls) else ())]
        numbers, _ = mirror.numbers({}, ())
        self.indices = (numbers, lay(pushed), lay(speeds), lay(forces))

    def rows(self, time: Any, pushed: Any, begin: Any, end: Any, exerted: Any, before: Any) -> Columns:
        """Rows of the ledger for S steps, in the order of their times.

        Args:
            time: (S + 1,) s.
            pushed: (S, …) the inputs that act.
            begin, end: (S, …) velocities at both ends.
            exerted: (S, C) forces of the actuators.
            before: (C,) controls before the first step.
        """
        import numpy as np

        step = np.diff(time)
        parts = [*self._controlled(pushed, begin, end, exerted, before, step)]
        parts += [*self._external(pushed, begin, end, step), *self._generalised(pushed, begin, end, step)]
        at = np.concatenate([np.zeros(0, np.intp), *(part[0] for part in parts)])
        order = np.argsort(at, kind="stable")
        counts = np.array([len(part[0]) for part in parts], np.intp)
        kinds = Words(np.repeat(np.arange(len(parts), dtype=np.int32), counts), [part[1] for part in parts])
        called = Words.joined([part[2] for part in parts])
        values = np.concatenate([np.zeros((0, VALUES)), *(part[3] for part in parts)])
        works = np.concatenate([np.zeros(0), *(part[4] for part in parts)])
        return {
            "time": time[at][order],
            "kind": kinds.taken(order),
            "target": called.taken(order),
            "value": values[order],
            "work_j": works[order],
        }

    def _controlled(
        self, pushed: Any, begin: Any, end: Any, exerted: Any, before: Any, step: Any
    ) -> "Iterator[tuple[Any, str, Words, Any, Any]]":
        """(steps, kind, target, values, works) of each actuator, while its control is not zero or changes."""
        import numpy as np

        value, speed = pushed[:, self._parts["ctrl"]], self._parts["drive"]
        former = np.concatenate([before[None], value[:-1]])
        works = exerted * (begin[:, speed] + end[:, speed]) / 2 * step[:, None]
        told = (value != 0) | (value != former)
        yield _told("control", self._actuators, told, np.stack([value, exerted], axis=2), slice(0, 2), works)

    def _external(self, pushed: Any, begin: Any, end: Any, step: Any) -> "Iterator[tuple[Any, str, Words, Any, Any]]":
        """Forces (N) and torques (N·m) on bodies, at their centres of mass, world frame."""

        wrench = pushed[:, self._parts["xfrc"]].reshape(len(step), -1, 6)
        if not wrench.any():
            return
        motion = (self._twist(begin) + self._twist(end)) / 2
        for kind, part in WRENCH.items():
            vector = wrench[..., part]
            works = (vector * motion[..., part]).sum(axis=2) * step[:, None]
            yield _told(kind, self._called, vector.any(axis=2), vector, part, works)

    def _twist(self, speeds: Any) -> Any:
        """(S, B, 6) m/s and rad/s: velocity of the bodies' centres of mass and angular velocity, world frame."""
        import numpy as np

        velocity = speeds[:, self._parts["cvel"]].reshape(len(speeds), -1, 6)
        arm = (speeds[:, self._parts["centre"]] - speeds[:, self._parts["tree"]]).reshape(len(speeds), -1, 3)
        spin = velocity[..., :3]
        return np.concatenate([velocity[..., 3:] + np.cross(spin, arm), spin], axis=2)

    def _generalised(
        self, pushed: Any, begin: Any, end: Any, step: Any
    ) -> "Iterator[tuple[Any, str, Words, Any, Any]]":
        """Forces on joints, as force (N) or torque (N·m) on the bodies that own them, world frame."""
        import numpy as np

        force = pushed[:, self._parts["qfrc"]]
        if not force.any():
            return
        # Forces and velocities of joints are dual: their product is the power, whatever their frame.
        power = force * (begin[:, self._parts["qvel"]] + end[:, self._parts["qvel"]]) / 2
        turned = begin[:, self._parts["turned"]].reshape(len(step), -1, 3, 3)
        axis = begin[:, self._parts["axis"]].reshape(len(step), -1, 3)
        for kind, mine in self._by_kind.items():
            owners = [self._owners[j] for j in mine.joints]

            def told(word: str, dofs: Any, vector: Any, owners: list[str] = owners) -> Any:
                works = power[:, dofs].sum(axis=2) * step[:, None]
                return _told(word, owners, vector.any(axis=2), vector, WRENCH[word], works)

            if kind == FREE:
                yield told("force", mine.dofs[:, :3], force[:, mine.dofs[:, :3]])
            if kind in (FREE, BALL):
                own = force[:, mine.dofs[:, -3:]]
                yield told("torque", mine.dofs[:, -3:], np.einsum("sjkl,sjl->sjk", turned[:, mine.joints], own))
            else:
                vector = axis[:, mine.joints] * force[:, mine.dofs]
                yield told("torque" if kind == HINGE else "force", mine.dofs, vector)


class _Alike(NamedTuple):
    """Joints of one kind: their places among the pushed ones, and of their forces, (J,) and (J, dofs)."""

    joints: Any
    dofs: Any


def _alike(kinds: Any) -> dict[int, _Alike]:
    """The joints by their kind, for joints of these kinds whose forces lie one after the other."""
    import numpy as np

    width = np.array([{FREE: 6, BALL: 3}.get(int(kind), 1) for kind in kinds], np.intp)
    first = np.cumsum(width) - width
    found = {}
    for kind in dict.fromkeys(int(kind) for kind in kinds):
        mine = np.flatnonzero(kinds == kind)
        found[kind] = _Alike(mine, first[mine][:, None] + np.arange(width[mine[0]]))
    return found


def _told(kind: str, targets: Sequence[str], acts: Any, vectors: Any, part: slice, works: Any) -> Any:
    """(steps, kind, targets, values, works) of the rows of one kind.

    Args:
        kind: of the rows.
        targets: names of B bodies or actuators.
        acts: (S, B) whether there is a row.
        vectors: (S, B, …) their numbers, which become this `part` of the values.
        part: of the values.
        works: (S, B) J.
    """
    import numpy as np

    at, which = np.nonzero(acts)
    values = np.zeros((len(at), VALUES))
    values[:, part] = vectors[at, which]
    return at, kind, Words(which.astype(np.int32), targets), values, works[at, which]


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


def _dofs(model: "mujoco.MjModel", joint: int) -> slice:
    first = int(model.jnt_dofadr[joint])
    return slice(first, first + {FREE: 6, BALL: 3}.get(int(model.jnt_type[joint]), 1))
