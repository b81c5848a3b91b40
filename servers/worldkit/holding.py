"""Undoing, or shrinking, what a program writes: the part of a variant that acts while it is simulated.

Before the program's `control` runs, every input that is held shows the program what it wrote itself the last time;
after it, what it wrote is remembered and the engine is given the share of it that the variant leaves. A program that
builds on its own last value (`mocap_pos[0] += v * dt`) therefore works as if nothing were changed. Positions and
velocities belong to the engine: of those, the *change* that `control` made is what shrinks.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING, Any

from .describe import names
from .interventions import refresh

if TYPE_CHECKING:
    import mujoco
    import numpy as np


SHAPING = ("eq_active", "mocap_pos", "mocap_quat")
"""Inputs that positions and constraints derive from, before forces come in."""


class Hold:
    """What is held of the program's writes, by kind of intervention; `around` makes a control function of it."""

    def __init__(self, model: "mujoco.MjModel") -> None:
        self._model = model
        self._inputs: dict[tuple[str, int], float] = {}  # (array, flat index) -> share left
        self._coordinates: dict[tuple[str, int], float] = {}  # (qpos or qvel, joint) -> share left
        self._owners: dict[str, float] = {}  # parameters of these owners -> share left
        self._callbacks: list[str] = []
        self._silent = False

    def everything(self) -> None:
        """The program's control is not called at all."""
        self._silent = True

    def write(self, kind: str, target: str, share: float) -> None:
        """Leave only this share of what the program writes of this kind to this target (see `variants`)."""
        model = self._model
        if kind == "parameter":
            self._owners[target] = share
        elif kind == "callback":
            self._callbacks.append(target.removeprefix("mjcb_"))
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
                self._coordinates["qpos" if kind == "pose" else "qvel", joint] = share
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
            self._inputs[array, int(entry)] = share

    def around(
        self, control: Callable[..., Any] | None
    ) -> Callable[["mujoco.MjModel", "mujoco.MjData"], object] | None:
        """The control function of the variant; the program's own when nothing is held of it."""
        self._uninstall()
        if self._silent:
            control = None
        if not (self._inputs or self._coordinates or self._owners or self._callbacks):
            return control
        return _Held(self._model, control, self._inputs, self._coordinates, self._owners, self._uninstall)

    def _uninstall(self) -> None:
        import mujoco

        for name in self._callbacks:
            getattr(mujoco, f"set_mjcb_{name}")(None)


class _Held:
    """A control function whose writes are held."""

    def __init__(
        self,
        model: "mujoco.MjModel",
        control: Callable[..., Any] | None,
        inputs: dict[tuple[str, int], float],
        coordinates: dict[tuple[str, int], float],
        owners_: dict[str, float],
        uninstall: Callable[[], None],
    ) -> None:
        import numpy as np

        self._control, self._uninstall = control, uninstall
        self._groups = [
            (
                array,
                np.array([i for a, i in inputs if a == array]),
                np.array([s for (a, _), s in inputs.items() if a == array]),
            )
            for array in dict.fromkeys(a for a, _ in inputs)
        ]
        self._authored: dict[str, np.ndarray] = {}
        self._first: dict[str, np.ndarray] = {}
        self._coordinates = coordinates
        self._parameters = _Parameters(model, owners_) if owners_ else None

    def __call__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        for array, index, _ in self._groups:
            flat = getattr(data, array).reshape(-1)
            if array in self._authored:
                flat[index] = self._authored[array]
            else:
                self._first[array] = flat[index].copy()
        before = (data.qpos.copy(), data.qvel.copy()) if self._coordinates else None
        if self._control is not None:
            self._control(model, data)
        self._uninstall()
        stale = False
        for array, index, share in self._groups:
            flat = getattr(data, array).reshape(-1)
            self._authored[array] = flat[index].copy()
            flat[index] = left = self._left(array, flat[index], share)
            stale |= array in SHAPING and left.tobytes() != self._authored[array].tobytes()
        if stale:  # the program may have had the engine derive everything from what it wrote
            refresh(model, data)
        if before is not None:
            self._take_back(model, data, *before)
        if self._parameters is not None:
            self._parameters.take_back()

    def _left(self, array: str, wanted: "np.ndarray", share: "np.ndarray") -> "np.ndarray":
        """The share of what is wanted: of forces from zero, of poses and switches from where they were at first."""
        import numpy as np

        first = self._first[array]
        if array == "eq_active":
            return np.where(share == 0, first, wanted)
        if array == "ctrl":
            return np.where(share == 0, first, wanted * share)
        if array == "mocap_pos":
            return first + (wanted - first) * share
        if array == "mocap_quat":
            return np.concatenate(
                [
                    _turned(a, b, s)
                    for a, b, s in zip(first.reshape(-1, 4), wanted.reshape(-1, 4), share[::4], strict=True)
                ]
            )
        return wanted * share

    def _take_back(
        self, model: "mujoco.MjModel", data: "mujoco.MjData", qpos: "np.ndarray", qvel: "np.ndarray"
    ) -> None:
        import mujoco
        import numpy as np

        moved = data.qpos.tobytes() != qpos.tobytes()
        if not moved and data.qvel.tobytes() == qvel.tobytes():
            return
        change, left = np.zeros(model.nv), data.qpos.copy()
        mujoco.mj_differentiatePos(model, change, 1.0, qpos, data.qpos)
        for (array, joint), share in self._coordinates.items():
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


class _Parameters:
    """Undoes edits of the model's arrays that belong to some owners."""

    def __init__(self, model: "mujoco.MjModel", owners_: dict[str, float]) -> None:
        from .watch import Watch

        self._model, self._owners = model, owners_
        self._watch = Watch(model)
        self._pristine = self._watch.values()

    def take_back(self) -> None:
        """Give back to every edited element of these owners the share of the edit that is left."""
        import numpy as np

        from .watch import owner_of

        for edit in self._watch.changes():
            for target, index, _ in owner_of(self._model, edit):
                owner = target.partition(".")[0].partition("[")[0]
                share = self._owners.get(target, self._owners.get(owner, self._owners.get(edit.array)))
                if share is None:
                    continue
                array = edit.array.removeprefix("opt.")
                live = getattr(self._model.opt if edit.array.startswith("opt.") else self._model, array)
                if not isinstance(live, np.ndarray):
                    setattr(self._model.opt, array, type(live)(self._pristine[edit.array][0]))
                    continue
                flat, old = live.reshape(-1), self._pristine[edit.array]
                flat[index] = old[index] + ((flat[index] - old[index]) * share).astype(old.dtype)
        self._watch.changes()  # what was taken back is no edit


def found(known: list[str], target: str) -> int:
    """Index of what a target of the ledger names (`cart/motor`, `gaze[0]`, `ball/hinge`); -1 when nothing is so called."""
    bare = target.partition("[")[0]
    meant = (target, bare, bare.rpartition("/")[2], bare.partition("/")[2], bare.partition("/")[0])
    return next((known.index(name) for name in meant if name in known), -1)


def _turned(first: "np.ndarray", wanted: "np.ndarray", share: float) -> "np.ndarray":
    """The orientation that lies this share of the way from one to another."""
    import mujoco
    import numpy as np

    between = np.zeros(3)
    mujoco.mju_subQuat(between, wanted, first)
    turned = first.copy()
    mujoco.mju_quatIntegrate(turned, between, float(share))
    return turned
