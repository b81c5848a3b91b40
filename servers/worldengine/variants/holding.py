"""Undo or shrink what is sent to a world: the part of a variant that acts while it is simulated.

A variant is another world, whose author is asked anew. Of its answers, every held input is scaled to the share that the
variant leaves; the author is shown those inputs as it wrote them the last time. A program that builds
on its own last value (`mocap_pos[0] += v * dt`) therefore works as if nothing were changed. Positions and velocities belong
to the engine: of those, the wanted *change* shrinks.
"""

from typing import TYPE_CHECKING, Any

from worldkit.naming import names
from worldkit.speaking import HELD, STATE, SWITCHES

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from worldkit.model_arrays import Edit

    from ..inputs.ports import Ports


class Hold:
    """The held inputs, by kind of intervention; `shares` applies them to the answers."""

    def __init__(self, model: "mujoco.MjModel") -> None:
        self._model = model
        self.inputs: dict[tuple[str, int], float] = {}
        """The share left, by (array, flat index)."""
        self.coordinates: dict[tuple[str, int], float] = {}
        """The share left, by (qpos or qvel, joint)."""
        self.owners: dict[str, float] = {}
        """The share left of the parameters, by their owner."""
        self.laws: dict[str, float] = {}
        """The share left of a law of the world (`opt.wind`), counted from nought and not from what the model begins with."""
        self.silent = False
        """If set, the author's `control` is never asked."""

    def everything(self) -> None:
        """Hold everything that `control` writes: it is never asked."""
        self.silent = True

    def shares(self) -> "Shares | None":
        """The shares to apply to the answers; None when all of them are left whole."""
        return Shares(self) if self.inputs or self.coordinates or self.owners or self.laws else None

    def write(self, kind: str, target: str, share: float) -> None:
        """Leave only this share of writes of this kind to this target (see `altered`)."""
        model = self._model
        if kind == "parameter":
            self.owners[target] = share
        elif kind == "control":
            actuator = found(names(model, "actuator", len(model.actuator_trntype)), target)
            first, count = model.actuator_ctrladr[actuator], model.actuator_ctrlnum[actuator]
            self._input("ctrl", range(first, first + count), share)
        elif kind == "constraint":
            self._input("eq_active", [found(names(model, "equality", model.neq), target)], share)
        else:
            self._body(kind, found(names(model, "body", model.nbody), target), share)

    def _body(self, kind: str, body: int, share: float) -> None:
        model = self._model
        joints = range(model.body_jntadr[body], model.body_jntadr[body] + model.body_jntnum[body])
        if kind == "mocap":
            mocap = int(model.body_mocapid[body])
            if mocap >= 0:
                self._input("mocap_pos", range(3 * mocap, 3 * mocap + 3), share)
                self._input("mocap_quat", range(4 * mocap, 4 * mocap + 4), share)
        elif kind in ("pose", "velocity"):
            for joint in joints:
                self.coordinates["qpos" if kind == "pose" else "qvel", joint] = share
        elif kind in ("force", "torque"):
            first = 6 * body + (3 if kind == "torque" else 0)
            self._input("xfrc_applied", range(first, first + 3), share)
            for joint in joints:
                start, type_ = int(model.jnt_dofadr[joint]), int(model.jnt_type[joint])
                linear = {0: range(start, start + 3), 2: range(start, start + 1)}.get(type_, range(0))
                angular = {0: range(start + 3, start + 6), 1: range(start, start + 3), 3: range(start, start + 1)}
                self._input("qfrc_applied", linear if kind == "force" else angular.get(type_, range(0)), share)

    def _input(self, array: str, entries: Any, share: float) -> None:
        for entry in entries:
            self.inputs[array, int(entry)] = share


class Shares:
    """The share of each entry of an answer that a variant leaves."""

    def __init__(self, hold: Hold) -> None:
        self._hold = hold

    def begin(self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: "Ports") -> None:
        """Remember the inputs before the first answer."""
        import numpy as np

        from worldkit import model_arrays

        self._model, self._data = model, data
        entries = ports.entries

        def of(arrays: tuple[str, ...]) -> "tuple[np.ndarray, np.ndarray, list[str]]":
            pairs = [(name, i) for name in arrays for i in entries.get(name, ())]
            share = np.array([self._hold.inputs.get(pair, 1.0) for pair in pairs])
            first = np.array([float(getattr(data, name).reshape(-1)[i]) for name, i in pairs])
            return share, first, [name for name, _ in pairs]

        self._push, first, arrays = of(HELD)
        control = np.array([name == "ctrl" for name in arrays], bool)
        self._stays = np.where(control & (self._push == 0), first, 0.0)
        self._authored = first
        self._part: dict[str, slice] = {}
        at = 0
        for name in STATE:
            count = len(entries.get(name, ()))
            self._part[name], at = slice(at, at + count), at + count
        self._state, self._state_first, _ = of(STATE)
        self._wanted = self._state_first.copy()
        self._flip, self._flip_first, _ = of(SWITCHES)
        self._index = {name: np.array(entries.get(name, ()), np.intp) for name in (*STATE, *SWITCHES)}
        self._pristine = model_arrays.values(model) if self._hold.owners else {}

    def show(self, numbers: "np.ndarray", held: "np.ndarray", state: "np.ndarray") -> None:
        """Write into the author's copy of the data, for held inputs, what the author wrote itself."""
        mine = self._push != 1.0
        numbers[held[mine]] = self._authored[mine]
        mine = self._state != 1.0
        numbers[state[mine]] = self._wanted[mine]

    def of_pushes(self, wanted: "np.ndarray") -> "np.ndarray":
        """The forces and controls that are left: forces shrink to zero, a control that is off keeps its first value."""
        self._authored = wanted.copy()
        return wanted * self._push + self._stays

    def change(self, moves: "np.ndarray", flips: "np.ndarray") -> None:
        """Write the changes of the state that are left."""
        import numpy as np

        data = self._data
        before = data.qpos.copy(), data.qvel.copy()
        written = ~np.isnan(moves)
        self._wanted[written] = moves[written]
        for name in STATE:
            part, index = self._part[name], self._index[name]
            mine = written[part]
            if mine.any() and name not in ("mocap_pos", "mocap_quat"):
                getattr(data, name).reshape(-1)[index[mine]] = moves[part][mine]
        self._take_back(*before)
        if written[self._part["mocap_pos"]].any():
            part = self._part["mocap_pos"]
            first, wanted = self._state_first[part], self._wanted[part]
            data.mocap_pos.reshape(-1)[self._index["mocap_pos"]] = first + (wanted - first) * self._state[part]
        if written[self._part["mocap_quat"]].any():
            part = self._part["mocap_quat"]
            rows = zip(
                self._state_first[part].reshape(-1, 4),
                self._wanted[part].reshape(-1, 4),
                self._state[part][::4],
                strict=True,
            )
            data.mocap_quat.reshape(-1)[self._index["mocap_quat"]] = np.concatenate(
                [_turned(a, b, s) for a, b, s in rows]
            )
        flipped = ~np.isnan(flips) & (self._flip != 0)
        data.eq_active[self._index["eq_active"][flipped]] = flips[flipped] != 0

    def of_parameters(self, edit: "Edit") -> "np.ndarray":
        """The new values of one array that are left."""
        if edit.array in self._hold.laws:
            return edit.values * self._hold.laws[edit.array]
        import numpy as np

        from worldkit.model_arrays import owner_of

        values, at = edit.values.copy(), {int(i): n for n, i in enumerate(edit.index)}
        for target, index, _ in owner_of(self._model, edit):
            owner = target.partition(".")[0].partition("[")[0]
            owners = self._hold.owners
            share = owners.get(target, owners.get(owner, owners.get(edit.array)))
            if share is not None:
                mine = [at[int(i)] for i in index]
                old = np.asarray(self._pristine[edit.array][index], float)
                values[mine] = old + (values[mine] - old) * share
        return values

    def _take_back(self, qpos: "np.ndarray", qvel: "np.ndarray") -> None:
        import mujoco
        import numpy as np

        model, data = self._model, self._data
        moved = data.qpos.tobytes() != qpos.tobytes()
        if not moved and data.qvel.tobytes() == qvel.tobytes():
            return
        change, left = np.zeros(model.nv), data.qpos.copy()
        mujoco.mj_differentiatePos(model, change, 1.0, qpos, data.qpos)
        for (array, joint), share in self._hold.coordinates.items():
            first = int(model.jnt_dofadr[joint])
            dofs = slice(first, model.jnt_dofadr[joint + 1] if joint + 1 < model.njnt else model.nv)
            if array == "qvel":
                data.qvel[dofs] = qvel[dofs] + (data.qvel[dofs] - qvel[dofs]) * share
            elif moved and change[dofs].any():
                one = np.zeros(model.nv)
                one[dofs] = change[dofs] * share
                there = qpos.copy()
                mujoco.mj_integratePos(model, there, one, 1.0)
                start = int(model.jnt_qposadr[joint])
                end = model.jnt_qposadr[joint + 1] if joint + 1 < model.njnt else model.nq
                left[start:end] = there[start:end] if share else qpos[start:end]
        if moved:
            data.qpos[:] = left


def found(known: list[str], target: str) -> int:
    """The index of what a target of the ledger names (`cart/motor`, `gaze[0]`, `ball/hinge`); -1 for unknown names."""
    bare = target.partition("[")[0]
    meant = (target, bare, bare.rpartition("/")[2], bare.partition("/")[2], bare.partition("/")[0])
    return next((known.index(name) for name in meant if name in known), -1)


def _turned(first: "np.ndarray", wanted: "np.ndarray", share: float) -> "np.ndarray":
    """The orientation at this share of the way from one to another."""
    import mujoco
    import numpy as np

    between = np.zeros(3)
    mujoco.mju_subQuat(between, wanted, first)
    turned = first.copy()
    mujoco.mju_quatIntegrate(turned, between, float(share))
    return turned
