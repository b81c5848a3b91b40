"""Note what pushes during a step, and the work it does: forces and torques on bodies and joints, controls of actuators.

The work of a force that is constant over a step is that force times the mean of the velocities at both ends, times the step:
exactly the kinetic energy that it hands to a body of constant mass. So a step's inputs and velocities are noted while it
happens, one copy of a few numbers each, and everything is worked out later for a thousand steps at once.
"""

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING, Any, NamedTuple

from worldkit.mirror import Mirror
from worldkit.naming import names

from ..recording.describing import actuator_columns, pulled_bodies
from ..recording.push_blocks import Block
from .force_outputs import outputs

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from .ports import Ports

ROWS = 1024
MOST_BYTES = 4 << 20
FREE, BALL, SLIDE, HINGE = range(4)
"""mjtJoint."""
WRENCH = {"force": range(3), "torque": range(3, 6)}
"""Numbers of a body's wrench in `xfrc_applied`, by kind."""


class Pushes:
    """Notes of consecutive steps; `emit` receives a function that makes blocks of the ledger of them (`push_blocks`).

    A step goes: `measure()` when velocities are computed, `interfered()` if the state was then written, `note()` once the
    inputs in force are known, `reacted()` once forces are. `measure()` and `finish()` once more at the end of the run.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: "Ports",
        emit: Callable[[Callable[[], Iterator[Block]]], object],
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

        fresh = [np.empty((self._capacity + 1, *note.shape[1:])) for note in self._notes]
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
        begin, end, exerted = self._speed[:steps], self._speed[1 : steps + 1], self._exerted[:steps]
        ends = {step: speed for step, speed in self._ends.items() if step < steps}
        if ends:
            end = end.copy()
            end[list(ends)] = list(ends.values())
        self._last_controls = pushed[-1, : len(book.controls)].copy()
        if len(self._inputs):
            self._emit(lambda: book.blocks(time, pushed, begin, end, exerted, before))
        self._start(self._count - steps)


class _Book:
    """Knows where in the data the inputs, velocities and forces are, and makes blocks of them."""

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: "Ports") -> None:
        import numpy as np

        self._model = model
        bodies, joints = names(model, "body", model.nbody), names(model, "joint", model.njnt)
        self.controls = np.array(ports.entries.get("ctrl", ()), np.intp)
        self._pushed = _by_body(ports.entries.get("xfrc_applied", ()))
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
        self._called = {kind: [bodies[b] for b in of] for kind, of in self._pushed.items()}
        # Where a body is all of its tree, its own centre of mass is the one that its velocity refers to.
        self._carried = np.flatnonzero(~_alone(model)[self._pushed["force"]])
        carried = self._pushed["force"][self._carried]
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

        def numbers_of(items: Any, width: int, wanted: Any) -> Any:
            """The wanted numbers of each item, the first of all items, then the second, …"""
            return (np.asarray(items, np.intp) * width + np.array(wanted)[:, None]).reshape(-1)

        all_dofs = np.concatenate([np.zeros(0, np.intp), *(np.arange(s.start, s.stop) for s in self._dofs.values())])
        pushed = [
            ("ctrl", "ctrl", self.controls),
            ("qfrc", "qfrc_applied", all_dofs),
            *((kind, "xfrc_applied", numbers_of(of, 6, WRENCH[kind])) for kind, of in self._pushed.items()),
        ]
        speeds = [
            ("drive", "actuator_velocity", output[self.controls] if len(self.controls) else ()),
            ("qvel", "qvel", all_dofs),
            ("moves", "cvel", numbers_of(self._pushed["force"], 6, range(3, 6))),
            ("turns", "cvel", numbers_of(self._pushed["torque"], 6, range(3))),
            ("spin", "cvel", numbers_of(carried, 6, range(3))),
            ("centre", "xipos", numbers_of(carried, 3, range(3))),
            ("tree", "subtree_com", numbers_of(model.body_rootid[carried], 3, range(3))),
            ("turned", "xmat", each(owner, 9)),
            ("axis", "xaxis", each(self._joints, 3)),
        ]
        forces = [("exerted", "actuator_force", output[self.controls] if len(self.controls) else ())]
        numbers, _ = mirror.numbers({}, ())
        self.indices = (numbers, lay(pushed), lay(speeds), lay(forces))

    def blocks(self, time: Any, pushed: Any, begin: Any, end: Any, exerted: Any, before: Any) -> Iterator[Block]:
        """What pushed over S steps.

        Args:
            time: (S + 1,) s.
            pushed: (S, …) the inputs that act.
            begin, end: (S, …) velocities at both ends.
            exerted: (S, C) forces of the actuators.
            before: (C,) controls before the first step.
        """
        import numpy as np

        half, time = np.diff(time)[:, None] / 2, time[:-1]
        if len(self.controls):
            yield self._controlled(time, half, pushed, begin, end, exerted, before)
        if len(self._pushed["force"]):
            velocity = self._at(begin, "moves") + self._at(end, "moves")
            if len(self._carried):
                velocity[:, :, self._carried] += self._round(begin) + self._round(end)
            yield self._external("force", time, half, pushed, velocity)
        if len(self._pushed["torque"]):
            yield self._external("torque", time, half, pushed, self._at(begin, "turns") + self._at(end, "turns"))
        if len(self._joints):
            yield from self._generalised(time, half, pushed, begin, end)

    def _controlled(self, time: Any, half: Any, pushed: Any, begin: Any, end: Any, exerted: Any, before: Any) -> Block:
        """Each actuator, while its control is not zero or changes: the control, and its force."""
        import numpy as np

        value, speed = pushed[:, self._parts["ctrl"]], self._parts["drive"]
        former = np.concatenate([before[None], value[:-1]])
        works = exerted * (begin[:, speed] + end[:, speed]) * half
        return Block("control", time, self._actuators, (value != 0) | (value != former), (value, exerted), works)

    def _external(self, kind: str, time: Any, half: Any, pushed: Any, velocity: Any) -> Block:
        """Forces (N) or torques (N·m) on B bodies, at their centres of mass, world frame; `velocity` (S, 3, B) is that of both ends, summed."""
        x, y, z = vector = self._at(pushed, kind).swapaxes(0, 1)
        works = x * velocity[:, 0]
        works += y * velocity[:, 1]
        works += z * velocity[:, 2]
        works *= half
        return Block(kind, time, self._called[kind], (x != 0) | (y != 0) | (z != 0), vector, works)

    def _at(self, noted: Any, part: str) -> Any:
        """(S, 3, B) what was noted of B bodies."""
        return noted[:, self._parts[part]].reshape(len(noted), 3, -1)

    def _round(self, speeds: Any) -> Any:
        """(S, 3, B) m/s: how much faster the centre of mass of a body in a tree is than what moves with it at the tree's."""
        import numpy as np

        arm = self._at(speeds, "centre") - self._at(speeds, "tree")
        return np.cross(self._at(speeds, "spin"), arm, axis=1)

    def _generalised(self, time: Any, half: Any, pushed: Any, begin: Any, end: Any) -> Iterator[Block]:
        """Forces on joints, as force (N) or torque (N·m) on the bodies that own them, world frame."""
        import numpy as np

        force = pushed[:, self._parts["qfrc"]]
        if not force.any():
            return
        # Forces and velocities of joints are dual: their product is the power, whatever their frame.
        power = force * (begin[:, self._parts["qvel"]] + end[:, self._parts["qvel"]])
        turned = begin[:, self._parts["turned"]].reshape(len(time), -1, 3, 3)
        axis = begin[:, self._parts["axis"]].reshape(len(time), -1, 3)
        for joint, mine in self._by_kind.items():
            owners = [self._owners[j] for j in mine.joints]

            def told(kind: str, dofs: Any, vector: Any, owners: list[str] = owners) -> Block:
                works = power[:, dofs].sum(axis=2) * half
                return Block(kind, time, owners, vector.any(axis=2), np.moveaxis(vector, 2, 0), works)

            if joint == FREE:
                yield told("force", mine.dofs[:, :3], force[:, mine.dofs[:, :3]])
            if joint in (FREE, BALL):
                own = force[:, mine.dofs[:, -3:]]
                yield told("torque", mine.dofs[:, -3:], np.einsum("sjkl,sjl->sjk", turned[:, mine.joints], own))
            else:
                vector = axis[:, mine.joints] * force[:, mine.dofs]
                yield told("torque" if joint == HINGE else "force", mine.dofs, vector)


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


def _by_body(entries: Any) -> dict[str, Any]:
    """(B,) bodies whose force, and whose torque, is among these entries of `xfrc_applied`."""
    import numpy as np

    bodies, numbers = np.divmod(np.array(entries, np.intp), 6)
    return {kind: np.unique(bodies[np.isin(numbers, wanted)]) for kind, wanted in WRENCH.items()}


def _alone(model: "mujoco.MjModel") -> Any:
    """(nbody,) bool: the bodies that nothing carries, and that carry nothing."""
    import numpy as np

    count = np.bincount(model.body_rootid, minlength=model.nbody)
    return count[model.body_rootid] == 1


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
