"""The ledger: whatever changes the state, or pushes on it, besides the engine's own step.

Around the program's `control` (and the engine callbacks it installs) the ledger compares the state, the inputs and the
model with what they were, and records per body and time only what changed or what pushes, with the work it did.

Work, in joules, done on the system:
    force, torque, control: force times the mean of the velocities at both ends of the step, times the step: exactly
        the kinetic energy that a constant force hands to a body of constant mass.
    pose, velocity: the jump in potential and in kinetic energy. Bodies that were only carried along count for the
        nearest carrier whose own joint was written.
    mocap: minus the force of the world on the mocap body times its displacement.
    constraint, parameter, callback: 0; what they do shows in the motion, not in the ledger.
"""

from collections.abc import Callable
from functools import cache
from typing import TYPE_CHECKING, Any

from .columns import VALUES
from .derived import Derived
from .describe import names
from .pushes import Event, Pushes, owners, twist
from .snapshot import Snapshot
from .watch import Watch, owner_of

if TYPE_CHECKING:
    import mujoco
    import numpy as np

CALLBACKS = (
    "control", "passive", "act_dyn", "act_gain", "act_bias", "sensor", "contactfilter",
)  # fmt: skip
"""Engine callbacks that can change the motion (`mjcb_…`)."""
BULK_EVERY = 256
"""Steps from one look at the bulky assets to the next."""
NO_CALLBACKS = (None,) * len(CALLBACKS)
MOST_ELEMENTS = 64
"""Elements listed of one model array edited at one instant."""


class Ledger:
    """Detects and records interventions of one simulation.

    A step goes: `settle()` when velocities are computed, `watch()` before anything may interfere, `watch_derived()`
    before `control`, the interference, `compare()`, and `reacted()` when forces are computed. `settle()` once more at
    the end of the run.

    Args:
        model, data: the world.
        event: where interventions and edits go.
        row: tells the index of the row that is being recorded.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", event: Event, row: Callable[[], int]) -> None:
        self._model, self._data, self._event, self._row = model, data, event, row
        self._snapshot = Snapshot(model, data)
        self._old, self._new, self._part = self._snapshot.old, self._snapshot.new, self._snapshot.part
        self._passive = CALLBACKS.index("passive")
        self._derived = Derived(model, data)
        self._bulk = Watch(model, bulky=True)
        self._steps = 0
        self._past: mujoco.MjData | None = None
        self._watch = Watch(model)
        self._bodies = names(model, "body", model.nbody)
        self._joints = names(model, "joint", model.njnt)
        self._equalities = names(model, "equality", model.neq)
        self._pushes = Pushes(model, data, event)
        self._callbacks: tuple[Any, ...] = NO_CALLBACKS
        self.check_callbacks()

    # -- callbacks ---------------------------------------------------------------------------------------------------

    def check_callbacks(self) -> bool:
        """Record engine callbacks that are new; tells whether any is installed."""
        found = installed_callbacks()
        if found != self._callbacks:
            for name, old, new in zip(CALLBACKS, self._callbacks, found, strict=True):
                if new is not old and new is not None:
                    self._record("callback", f"mjcb_{name}")
            self._callbacks = found
        return found != NO_CALLBACKS

    # -- around the interference -------------------------------------------------------------------------------------

    def watch(self) -> None:
        """Remember the state, before anything may interfere."""
        self._snapshot.remember()

    def watch_derived(self) -> None:
        """Remember what derives from the state, before `control` may write to it."""
        self._derived.remember()

    def compare(self) -> bool:
        """Record what interfered, and bring derived quantities up to date with what it wrote.

        Tells whether an engine callback is installed.
        """
        called_back = self.check_callbacks()
        for edit in self._watch.changes():
            self._parameters(edit)
        if self._steps % BULK_EVERY == 0:
            self.check_bulk()
        self._steps += 1
        slipped = self._derived.force()
        edited = self._derived.others()
        if self._snapshot.changed() and self._state():
            slipped, edited = None, []  # whatever derives from the state was computed anew
        if called_back and self._callbacks[self._passive] is not None:
            hidden = self._derived.called_back()
            slipped = hidden if slipped is None else slipped if hidden is None else slipped + hidden
        for name, values in edited:
            self._record("parameter", f"data.{name}", values)
        if slipped is not None:
            self._pushes.generalised(slipped)
        if not self._snapshot.pushing():
            return called_back
        part = self._part
        old, new = self._old[part["CTRL"]], self._new[part["CTRL"]]
        if self._new[part["XFRC_APPLIED"]].any():
            self._pushes.external()
        if self._new[part["QFRC_APPLIED"]].any():
            self._pushes.generalised(self._data.qfrc_applied)
        self._pushes.controls(((new != 0) | (new != old)).nonzero()[0])
        return called_back

    def check_bulk(self) -> None:
        """Record edits of assets that shape the motion (meshes, height fields); looked at now and then, and at the end."""
        for edit in self._bulk.changes():
            self._record("parameter", edit.array, edit.values)

    def _state(self) -> bool:
        """Record what was written to the state; tells whether everything that derives from it was computed anew."""
        import numpy as np

        def changed(name: str) -> "np.ndarray":
            part = self._part[name]
            return np.flatnonzero(self._old[part] != self._new[part])

        positions, velocities = changed("QPOS"), changed("QVEL")
        poses, turns = changed("MOCAP_POS"), changed("MOCAP_QUAT")
        switched = changed("EQ_ACTIVE")
        deformed = changed("PLASTIC")
        anew = bool(len(positions) or len(velocities) or len(poses) or len(turns) or len(switched) or len(deformed))
        if anew:
            refresh(self._model, self._data)
            self._look_back()
        if len(positions) or len(velocities):
            self._written(positions, velocities)
        for mocap in sorted({*(poses // 3), *(turns // 4)}):
            body = int(np.flatnonzero(self._model.body_mocapid == mocap)[0])
            moved = self._displacement(body)
            self._pushes.carried(body, moved)
        for equality in switched:
            value = self._new[self._part["EQ_ACTIVE"]][equality]
            load = 0.0 if value else self._load(int(equality))
            self._record("constraint", self._equalities[equality], (value, load))
        for name, target in (("ACT", "act"), ("PLASTIC", "plastic"), ("TIME", "time")):
            for index in changed(name)[:MOST_ELEMENTS]:
                part = self._part[name]
                self._record("parameter", f"{target}[{index}]", (self._new[part][index], self._old[part][index]))
        return anew

    def _look_back(self) -> None:
        """Compute what derived from the state before it was written, in a data of its own."""
        import mujoco

        if self._past is None:
            self._past = mujoco.MjData(self._model)
        mujoco.mj_setState(self._model, self._past, self._old, self._snapshot.signature)
        mujoco.mj_fwdKinematics(self._model, self._past)
        mujoco.mj_makeM(self._model, self._past)
        mujoco.mj_comVel(self._model, self._past)
        mujoco.mj_energyPos(self._model, self._past)
        mujoco.mj_energyVel(self._model, self._past)

    def _load(self, equality: int) -> float:
        """Norm of the force that an equality exerted in the remembered state, which no row shows once it is off."""
        import mujoco
        import numpy as np

        past = self._past
        assert past is not None
        mujoco.mj_forwardSkip(self._model, past, mujoco.mjtStage.mjSTAGE_NONE, 1)
        mine = past.efc_id[: past.ne] == equality
        return float(np.sqrt((past.efc_force[: past.ne][mine] ** 2).sum()))

    def _written(self, positions: "np.ndarray", velocities: "np.ndarray") -> None:
        """Poses and velocities of joints were written: displacement, change of velocity, jump in energy."""
        import numpy as np

        model, data, past = self._model, self._data, self._past
        assert past is not None
        moved = owners(model.jnt_qposadr, positions)
        pushed = owners(model.jnt_dofadr, velocities)
        written = sorted({*moved, *pushed})
        carrier = np.full(model.nbody, -1)
        for joint in written:
            carrier[model.jnt_bodyid[joint]] = model.jnt_bodyid[joint]
        for body in range(1, model.nbody):
            if carrier[body] < 0:
                carrier[body] = carrier[model.body_parentid[body]]
        fallen = -model.body_mass * ((data.xipos - past.xipos) @ model.opt.gravity)
        gained = kinetic(model, data) - kinetic(model, past)
        alone = len(set(model.jnt_bodyid[written])) == 1
        for body in dict.fromkeys(int(model.jnt_bodyid[joint]) for joint in written):
            joints = [j for j in written if model.jnt_bodyid[j] == body]
            share = carrier == body
            potential, motion = float(fallen[share].sum()), float(gained[share].sum())
            if alone:  # then springs count too
                potential, motion = (float(x) for x in data.energy - past.energy)
            own = self._bodies[body]
            target = own if model.body_jntnum[body] == 1 else f"{own}/{self._joints[joints[0]]}"
            pose, speed = any(j in moved for j in joints), any(j in pushed for j in joints)
            if pose:
                self._record("pose", target, self._displacement(body), potential if speed else potential + motion)
            if speed:
                self._record("velocity", target, self._acceleration(body), motion)

    def _displacement(self, body: int) -> "np.ndarray":
        """(6,) translation of the body's origin and rotation vector, from the remembered pose to the present one."""
        import mujoco
        import numpy as np

        past = self._past
        assert past is not None
        value, turn, back = np.zeros(VALUES), np.zeros(4), np.zeros(4)
        value[:3] = self._data.xpos[body] - past.xpos[body]
        mujoco.mju_negQuat(back, past.xquat[body])
        mujoco.mju_mulQuat(turn, self._data.xquat[body], back)
        mujoco.mju_quat2Vel(value[3:], turn, 1.0)
        return value

    def _acceleration(self, body: int) -> "np.ndarray":
        """(6,) change of the linear velocity of the body's centre of mass and of its angular velocity."""
        import numpy as np

        assert self._past is not None
        return np.asarray(twist(self._model, self._data, body) - twist(self._model, self._past, body))

    def _parameters(self, edit: Any) -> None:
        """A model array was edited: every value is kept for the replay; what touches the motion is an intervention."""
        time, row = self._data.time, self._row()
        for index, value in zip(edit.index, edit.values, strict=True):
            self._event("edits", time, row, edit.array, int(index), float(value))
        if not edit.looks_only:
            for target, _, values in owner_of(self._model, edit)[:MOST_ELEMENTS]:
                self._record("parameter", target, values)

    def reacted(self) -> None:
        """Forces are computed: see `Pushes.reacted`."""
        self._pushes.reacted()

    def settle(self) -> None:
        """The next velocities are computed: see `Pushes.settle`."""
        self._pushes.settle()

    def _record(self, kind: str, target: str, value: Any = (), work: float = 0.0) -> None:
        numbers = [float(v) for v in value][:VALUES]
        numbers += [0.0] * (VALUES - len(numbers))
        self._event("interventions", self._data.time, kind, target, tuple(numbers), work)


def installed_callbacks() -> tuple[Any, ...]:
    """The engine's callbacks in the order of `CALLBACKS`; None where none is installed."""
    return tuple([ask() for ask in _askers()])


@cache
def _askers() -> tuple[Callable[[], Any], ...]:
    import mujoco

    return tuple(getattr(mujoco, f"get_mjcb_{name}") for name in CALLBACKS)


def refresh(model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
    """Bring everything that derives from positions and velocities up to date, without calling anybody back."""
    import mujoco

    mujoco.mj_fwdPosition(model, data)
    mujoco.mj_sensorPos(model, data)
    mujoco.mj_energyPos(model, data)
    mujoco.mj_fwdVelocity(model, data)
    mujoco.mj_sensorVel(model, data)
    mujoco.mj_energyVel(model, data)


def kinetic(model: "mujoco.MjModel", data: "mujoco.MjData") -> "np.ndarray":
    """(nbody,) kinetic energy of each body, J (without joint armature)."""
    import numpy as np

    from .derive import velocity_at

    linear = velocity_at(data.xipos, data.cvel, data.subtree_com[model.body_rootid])
    local = np.einsum("bji,bj->bi", data.ximat.reshape(-1, 3, 3), data.cvel[:, :3])
    return np.asarray((model.body_mass * (linear**2).sum(axis=1) + (model.body_inertia * local**2).sum(axis=1)) / 2)
