"""Remember of each model and its data, while a program runs, what was written, what was computed and what was kept."""

import copy
from typing import Any

import meaning
import mujoco
import numpy as np
from said import SAID

READ: set[str] = set()
"""Fields that the program read."""
RAW: dict[tuple[type, str], Any] = {}
"""The engine's own properties, before they were watched."""
CALL: dict[str, Any] = {}
"""The engine's own functions."""
CALLBACKS: dict[str, tuple[Any, int, set[int]]] = {}
"""Global callbacks: function, line, models stepped since."""


def raw(owner: Any, name: str) -> Any:
    """An engine's field, without a note."""
    return RAW[(type(owner), name)].fget(owner)


class Owner:
    """A model or data."""

    def __init__(self, of: Any) -> None:
        self.of = of
        self.epoch = 0
        self.shapes: dict[str, Any] = {}

    def indices(self, name: str, shape: tuple[int, ...]) -> Any:
        """The flat index of every element of a field, in the field's shape."""
        found = self.shapes.get(name)
        if found is None or found.shape != shape:
            found = self.shapes[name] = np.arange(int(np.prod(shape))).reshape(shape)
        return found

    def size(self, name: str) -> int:
        """How many elements a field has."""
        found = self.shapes.get(name)
        return -1 if found is None else found.size

    def rank(self, name: str) -> int:
        """How many axes a field has."""
        found = self.shapes.get(name)
        return -1 if found is None else found.ndim


class ModelState(Owner):
    """One compiled model."""

    def __init__(self, of: Any) -> None:
        super().__init__(of)
        self.layout = meaning.Layout(of, raw)
        self.written: dict[str, tuple[int, set[int]]] = {}
        """Fields that the program wrote: line, and elements."""
        self.told: set[str] = set()
        self.key_used = False
        self.reset_line = 0
        self.made_line = 0
        self.made_stack: list[tuple[int, int]] = []
        self.keyed_text = False
        self.datas = 0
        self.first_step_line = 0
        self.first = {
            n: raw(of, n).copy()
            for n in ("body_subtreemass", "dof_invweight0", "actuator_acc0", "body_mass", "geom_size")
        }
        self.looked = 0
        self.version = 0
        """How often the program wrote into it."""
        self.starts = 0
        """How often a state of it was started anew."""
        self.changes: dict[str, dict[int, tuple[int, int]]] = {}
        """For each field and element: (starts when it was last changed from its own value, or -1; version)."""
        self.operands: dict[tuple[str, int, int], list[Any]] = {}
        self.piled: dict[int, int] = {}

    def turned(self, frame: Any) -> bool:
        """A model has no poses."""
        return True

    def now(self) -> None:
        """A model has no time."""


STATE = mujoco.mjtState
PHYSICS = ("act", "plastic", "history", "qfrc_applied", "xfrc_applied", "qvel", "eq_active")


class DataState(Owner):
    """One simulation state."""

    def __init__(self, of: Any, model: ModelState) -> None:
        super().__init__(of)
        self.model = model
        model.starts += 1
        self.layout = model.layout
        self.dirty: dict[str, int] = {"": 1}
        """Fields written since poses were computed, with the line; the empty name means that nothing was ever computed."""
        self.since_step: set[str] = set()
        self.starts: dict[bytes, dict[str, Any]] = {}
        self.start_line = 0
        self.fresh_start = False
        self.threads: set[int] = set()
        self.busy = 0
        self.replaced = 0
        self.warned = False
        self.last_time = 0.0
        self.spare: Any = None
        self.reset = True
        self.looked = 0
        self.blind: set[str] = set()
        """Fields that were read unwatched since the last step."""
        self.shared = False
        self.inputs: Any = None
        self.looked_for: dict[int, int] = {}
        """For each line: how often its contacts were compared."""
        self.writes: dict[str, int] = {}
        self.from_key: Any = None
        """(line, key) that the positions were just taken from."""
        self.partial = 0
        """The line that computed poses alone."""
        self.ever: set[str] = set()
        """Fields that the program wrote."""
        self.free_written: set[int] = set()
        """First coordinates of joints that the program wrote."""
        self.still_on: list[str] = []
        """Inputs that the present start did not clear."""

    def now(self) -> float:
        """Simulated time, s."""
        return float(raw(self.of, "time"))

    def turned(self, frame: tuple[str, int]) -> bool:
        """Whether a local frame is turned against the world now."""
        name = {"body": "xmat", "site": "site_xmat", "camera": "cam_xmat", "geom": "geom_xmat", "inertia": "ximat"}.get(
            frame[0]
        )
        if name is None:
            return True
        matrix = raw(self.of, name)[frame[1]]
        return not bool(np.allclose(matrix, np.eye(3).ravel(), atol=1e-3)) and bool(matrix.any())

    def row(self, name: str, index: int) -> Any:
        """One row of a field, without a note."""
        return raw(self.of, name)[index]

    def velocity(self, body: int) -> Any:
        """(3,) velocity of a body's origin, world frame, m/s."""
        out = np.zeros(6)
        CALL["mj_objectVelocity"](self.model.of, self.of, mujoco.mjtObj.mjOBJ_XBODY, body, out, 0)
        return out[3:]

    # -- what was computed ------------------------------------------------------------------------------------------

    def ahead(self, call: str) -> Any:
        """A copy of the state in which a function of the engine has been called."""
        model = self.model.of
        if self.spare is None:
            self.spare = mujoco.MjData(model)
        CALL["mj_copyData"](self.spare, model, self.of)
        active = [(n, f[0]) for n, f in CALLBACKS.items() if f[0] is not None]
        for name, _ in active:  # the program's own functions must not run once more than it asked for
            CALL[name](None)
        try:
            CALL[call](model, self.spare)
        finally:
            for name, function in active:
                CALL[name](function)
        return self.spare

    def wrote(self, name: str, line: int) -> None:
        """Note that the program wrote into the state."""
        self.since_step.add(name)
        self.ever.add(name)
        if name in ("qpos", "mocap_pos", "mocap_quat", "qvel"):
            self.dirty.setdefault(name, line)

    def read(self, name: str, line: int, at: Any = None) -> None:
        """Note that the program reads a value that the engine computes."""
        if name in INPUTS or self.replaced or not (self.dirty or (self.partial and name not in POSES)):
            return
        cause = "" if "" in self.dirty or not self.dirty else next(iter(self.dirty))
        if set(self.dirty) == {"qvel"} and name in POSES:
            return
        if name == "contact" or name.startswith("efc_"):
            return
        now = raw(self.of, name)
        then = raw(self.ahead("mj_forward"), name)
        if now.shape != then.shape:
            return
        if at is not None:
            now, then = now.ravel()[at], then.ravel()[at]
        scale = max(float(np.abs(then).max(initial=0.0)), 1e-6)
        if float(np.abs(now - then).max(initial=0.0)) > 1e-4 * scale + 1e-9:
            SAID.event("stale", line, name=name, cause=cause, wrote=self.dirty[cause] if cause else 0)

    def contacts(self, line: int) -> None:
        """Note that the program reads the contacts, or how many they are."""
        if self.dirty and not self.replaced and set(self.dirty) != {"qvel"} and self.looked_for.get(line, 0) < 20:
            self.looked_for[line] = self.looked_for.get(line, 0) + 1
            if int(raw(self.of, "ncon")) != int(raw(self.ahead("mj_forward"), "ncon")):
                cause = "" if "" in self.dirty else next(iter(self.dirty))
                SAID.event("stale", line, name="contact", cause=cause, wrote=self.dirty[cause] if cause else 0)

    def asked(self, name: str, line: int, at: Any = None) -> None:
        """Note that the program reads a value that is only computed when it is asked for."""
        call = ON_DEMAND.get(name)
        if call is None or self.epoch == 0:
            return
        now = raw(self.of, name)
        if now.any():
            return
        if name == "energy":
            spare = self.ahead("mj_energyPos")
            CALL["mj_energyVel"](self.model.of, spare)
            then = raw(spare, name)
        else:
            then = raw(self.ahead(call), name)
        if at is not None:
            then = then.ravel()[at]
        if float(np.abs(then).max(initial=0.0)) > 1e-6:
            SAID.event("not_computed", line, name=name, call=call)

    # -- starts -----------------------------------------------------------------------------------------------------

    def before_step(self, line: int) -> None:
        """Report a start from the same values as an earlier one, with other things left over."""
        if self.from_key is not None:
            self._key_in_part(*self.from_key)
            self.from_key = None
        if self.fresh_start:
            self.fresh_start = False
            key = raw(self.of, "qpos").tobytes()
            rest = {n: raw(self.of, n).copy() for n in PHYSICS}
            old = self.starts.get(key)
            if old is not None:
                left = [
                    n for n in PHYSICS
                    if n not in self.since_step | self.blind and n not in old["since"] and old[n].shape == rest[n].shape
                    and not np.allclose(old[n], rest[n], rtol=1e-6, atol=1e-9)
                ]  # fmt: skip
                if left:
                    SAID.event("left_over", self.start_line, name=", ".join(left))
                    self.still_on = left
            elif len(self.starts) < 200:
                self.starts[key] = {**rest, "since": self.since_step | self.blind}
        self.since_step.clear()
        self.blind.clear()
        self.fresh_start = False

    def _key_in_part(self, line: int, key: int) -> None:
        """Report that the positions of a keyframe are taken and the rest of it is not."""
        model, left = self.model.of, []
        for name in ("ctrl", "act", "qvel"):
            told, now = raw(model, f"key_{name}")[key], raw(self.of, name)
            unset = name not in self.ever | self.blind
            if told.shape == now.shape and told.any() and unset and not np.allclose(told, now):
                left.append(name)
        if left:
            SAID.event("key_in_part", line, name=", ".join(left))

    def cleared(self) -> None:
        """Note that everything was reset."""
        self.dirty = {"": 1}
        self.since_step.update(PHYSICS)
        self.model.starts += 1
        self.reset = True


INPUTS = {
    "qpos", "qvel", "act", "ctrl", "qfrc_applied", "xfrc_applied", "mocap_pos", "mocap_quat", "eq_active", "userdata",
    "qacc_warmstart", "history", "plastic", "plugin_state", "time", "energy", "act_dot",
    "subtree_linvel", "subtree_angmom", "cacc", "cfrc_int", "cfrc_ext", "qacc", "contact",
}  # fmt: skip
"""A program may read these at any time, or other checks speak of them."""
POSES = {
    n for n in meaning.DATA
    if n.endswith(("xpos", "xquat", "xmat", "xipos", "xiquat", "ximat", "xanchor", "xaxis", "subtree_com", "_length"))
}  # fmt: skip
ON_DEMAND = {
    "subtree_linvel": "mj_subtreeVel",
    "subtree_angmom": "mj_subtreeVel",
    "cacc": "mj_rnePostConstraint",
    "cfrc_int": "mj_rnePostConstraint",
    "cfrc_ext": "mj_rnePostConstraint",
    "energy": "mj_energyPos",
}
OWNERS: dict[int, Owner] = {}


def model_state(model: Any) -> ModelState:
    """What is remembered of a model."""
    found = OWNERS.get(id(model))
    if found is None:
        found = OWNERS[id(model)] = ModelState(model)
    return found  # type: ignore[return-value]


def data_state(data: Any) -> DataState:
    """What is remembered of data."""
    found = OWNERS.get(id(data))
    if found is None:
        model = model_state(data.model)
        model.datas += 1
        found = OWNERS[id(data)] = DataState(data, model)
    return found  # type: ignore[return-value]


LIMITS = {
    "jnt_range": "jnt_limited",
    "tendon_range": "tendon_limited",
    "actuator_forcerange": "actuator_forcelimited",
    "actuator_actrange": "actuator_actlimited",
    "actuator_ctrlrange": "actuator_ctrllimited",
    "jnt_actfrcrange": "jnt_actfrclimited",
}


def without_effect(state: ModelState, data: DataState | None) -> None:
    """Report what the program wrote into the model and the engine ignores."""
    model = state.of
    for name, flag in LIMITS.items():
        if name in state.written and (type(model), flag) in RAW:
            line, places = state.written[name]
            limited = np.asarray(raw(model, flag)).ravel()
            rows = {p // 2 for p in places}
            off = [r for r in rows if r < limited.size and not limited[r]]
            if off and len(off) == len(rows):
                SAID.event("limit_not_active", line, name=name, flag=flag)
    if "body_gravcomp" in state.written and not model.flg_gravcomp and raw(model, "body_gravcomp").any():
        SAID.event("gravcomp_not_active", state.written["body_gravcomp"][0])
    if "eq_active0" in state.written and data is not None and not data.reset:
        line = state.written["eq_active0"][0]
        if (np.asarray(raw(model, "eq_active0")) != np.asarray(raw(data.of, "eq_active"))).any():
            SAID.event("initial_value_only", line, name="eq_active0", live="data.eq_active")
    if "qpos0" in state.written and "setConst" not in state.told:
        SAID.event("constants_stale", state.written["qpos0"][0], name="qpos0", what="qpos_spring and the constants")


def constants(state: ModelState, name: str, line: int) -> None:
    """Report a constant that was computed before the numbers it follows from were changed."""
    if name not in (
        "body_subtreemass",
        "dof_invweight0",
        "body_invweight0",
        "tendon_length0",
        "actuator_acc0",
        "dof_M0",
    ):
        return
    if not state.written or "setConst" in state.told:
        return
    sources = {"body_mass", "body_inertia", "body_pos", "body_ipos", "dof_armature", "jnt_pos", "qpos0"} & set(
        state.written
    )
    if not sources:
        return
    twin = copy.copy(state.of)
    CALL["mj_setConst"](twin, mujoco.MjData(twin))
    if not np.allclose(raw(twin, name), raw(state.of, name), rtol=1e-6):
        SAID.event("constants_stale", line, name=min(sources), what=name)
