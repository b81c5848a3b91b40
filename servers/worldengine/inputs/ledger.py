"""Keep the ledger: the log of what was sent to a world, with the work that each entry did.

Only messages change a world besides the engine's own step, and every message passes through here, so nothing has to be
inferred. The ledger tells what acted: pushes while they push, changes of the state when they are made. By which law it acted is the
word of the plan's row that declares it: a name that the program gave its own pushes would be what it says of itself.

Work, in joules, done on the system:
    force, torque, control: see `pushes`.
    pose, velocity: the jump in potential and in kinetic energy. Bodies that were only carried along count for the
        nearest carrier whose own joint was written.
    mocap: minus the force of the world on the mocap body times its displacement.
    constraint, parameter: 0; what they do shows in the motion, not in the ledger.
"""

from typing import TYPE_CHECKING, Any

from worldkit.model_arrays import Edit, owner_of
from worldkit.naming import names
from worldkit.speaking import HELD

from ..recording.bonds import bonds_of
from ..recording.columns import VALUES
from .messages import Messages
from .pushes import Pushes, displacement, twist

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.record import Recorder
    from .ports import Ports

PARTS = ("TIME", "QPOS", "QVEL", "ACT", "EQ_ACTIVE", "MOCAP_POS", "MOCAP_QUAT", "PLASTIC", "USERDATA")
"""Components of the engine's state (`mjSTATE_…`) that can be changed by a message, and the time."""
MOST_ELEMENTS = 64
"""The ledger lists so many elements of one model array that is edited at one instant."""


class Ledger:
    """Keeps one simulation's ledger in its recording."""

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: "Ports", recorder: "Recorder") -> None:
        import mujoco
        import numpy as np

        self._model, self._data, self._recorder = model, data, recorder
        self.pushes = Pushes(model, data, ports, lambda blocks: recorder.later("pushes", blocks))
        lasting = sum(len(ports.entries.get(name, ())) for name in HELD)
        self.messages = Messages(recorder, lasting)
        recorder.before_flush.append(self._flush)
        self._bodies, self._joints = names(model, "body", model.nbody), names(model, "joint", model.njnt)
        self._equalities = names(model, "equality", model.neq)
        self._bonds = bonds_of(model)
        self._signature, offset = 0, 0
        self._part: dict[str, slice] = {}
        for name in PARTS:
            bit = int(getattr(mujoco.mjtState, f"mjSTATE_{name}"))
            self._signature |= bit
            width = mujoco.mj_stateSize(model, bit)
            self._part[name] = slice(offset, offset + width)
            offset += width
        self._old, self._new = np.zeros(offset), np.zeros(offset)
        self._past: mujoco.MjData | None = None
        self._carried: list[tuple[float, int, np.ndarray]] = []

    def _flush(self) -> None:
        self.pushes.flush()
        self.messages.flush()

    def finish(self) -> None:
        """Finish the ledger once the velocities of the last state are measured."""
        self.pushes.finish()
        self.messages.flush()

    # -- changes of the state ----------------------------------------------------------------------------------------

    def about_to_change(self) -> None:
        """Remember the state."""
        import mujoco

        mujoco.mj_getState(self._model, self._data, self._old, self._signature)

    def changed(self) -> None:
        """After a write to the state, bring everything that derives from it up to date, and note what changed."""
        import mujoco
        import numpy as np

        mujoco.mj_getState(self._model, self._data, self._new, self._signature)

        def changed(name: str) -> "np.ndarray":
            part = self._part[name]
            return np.flatnonzero(self._old[part] != self._new[part])

        positions, velocities, switched = changed("QPOS"), changed("QVEL"), changed("EQ_ACTIVE")
        poses, turns = changed("MOCAP_POS"), changed("MOCAP_QUAT")
        refresh(self._model, self._data)
        self.pushes.interfered()
        self._look_back()
        if len(positions) or len(velocities):
            self._written(positions, velocities)
        for mocap in sorted({*(poses // 3), *(turns // 4)}):
            body = int(np.flatnonzero(self._model.body_mocapid == mocap)[0])
            self._carried.append((self._data.time, body, self._displacement(body)))
        for equality in switched:
            value = self._new[self._part["EQ_ACTIVE"]][equality]
            carried = (0.0,) if value else self._carried_by(int(equality))
            self._record("constraint", self._equalities[equality], (value, *carried))
        for name, target in (("ACT", "act"), ("PLASTIC", "plastic"), ("USERDATA", "userdata")):
            for index in changed(name)[:MOST_ELEMENTS]:
                part = self._part[name]
                self._record("parameter", f"{target}[{index}]", (self._new[part][index], self._old[part][index]))

    def _look_back(self) -> None:
        """Compute, in an MjData of its own, what derived from the state before it was written."""
        import mujoco

        if self._past is None:
            self._past = mujoco.MjData(self._model)
        mujoco.mj_setState(self._model, self._past, self._old, self._signature)
        mujoco.mj_fwdKinematics(self._model, self._past)
        mujoco.mj_makeM(self._model, self._past)
        mujoco.mj_comVel(self._model, self._past)
        mujoco.mj_energyPos(self._model, self._past)
        mujoco.mj_energyVel(self._model, self._past)

    def _carried_by(self, equality: int) -> tuple[float, ...]:
        """What an equality carried in the remembered state, which no row shows once it is off: N and, of a bond, Pa."""
        import mujoco
        import numpy as np

        from worldkit.breaking.letting_go import stresses

        past = self._past
        assert past is not None
        mujoco.mj_forwardSkip(self._model, past, mujoco.mjtStage.mjSTAGE_NONE, 1)
        mine = past.efc_id[: past.ne] == equality
        force = float(np.sqrt((past.efc_force[: past.ne][mine] ** 2).sum()))
        bonds = self._bonds
        mine = np.flatnonzero(bonds.equality == equality) if bonds is not None else np.zeros(0, int)
        return (force, float(stresses(bonds, past)[mine[0]])) if bonds is not None and len(mine) else (force,)

    def _written(self, positions: "np.ndarray", velocities: "np.ndarray") -> None:
        """Note written poses and velocities of joints: displacement, change of velocity, jump in energy."""
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
            if alone:  # then springs count, too
                potential, motion = (float(x) for x in data.energy - past.energy)
            own = self._bodies[body]
            target = own if model.body_jntnum[body] == 1 else f"{own}/{self._joints[joints[0]]}"
            pose, speed = any(j in moved for j in joints), any(j in pushed for j in joints)
            if pose:
                self._record("pose", target, self._displacement(body), potential if speed else potential + motion)
            if speed:
                self._record("velocity", target, self._acceleration(body), motion)

    def _displacement(self, body: int) -> "np.ndarray":
        """(6,) m and rad: from the remembered pose of a body to the present one."""
        assert self._past is not None
        return displacement(self._data, body, self._past.xpos[body], self._past.xquat[body])

    def _acceleration(self, body: int) -> "np.ndarray":
        """(6,) m/s and rad/s: change of the velocity of the body's centre of mass and of its angular velocity."""
        import numpy as np

        assert self._past is not None
        return np.asarray(twist(self._model, self._data, body) - twist(self._model, self._past, body))

    # -- parameters and forces ---------------------------------------------------------------------------------------

    def edited(self, edit: Edit) -> None:
        """Note a written parameter: every value is kept for the replay; one that touches the motion is an intervention."""
        time, row, step = self._data.time, self._recorder.recorded, self.messages.step
        for index, value in zip(edit.index, edit.values, strict=True):
            self._recorder.event("edits", time, row, step, edit.array, int(index), float(value))
        if not edit.looks_only:
            for target, _, values in owner_of(self._model, edit)[:MOST_ELEMENTS]:
                self._record("parameter", target, values)

    def reacted(self) -> None:
        """Note the computed forces: of actuators, and of the world on the mocap bodies that were moved."""
        import mujoco

        self.pushes.reacted()
        if not self._carried:
            return
        mujoco.mj_rnePostConstraint(self._model, self._data)
        for _, body, moved in self._carried:
            torque, force = self._data.cfrc_ext[body, :3], self._data.cfrc_ext[body, 3:]
            work = -float(force @ moved[:3] + torque @ moved[3:])
            self._record("mocap", self._bodies[body], moved, work)
        self._carried.clear()

    def _record(self, kind: str, target: str, value: Any = (), work: float = 0.0) -> None:
        numbers = [float(v) for v in value][:VALUES]
        numbers += [0.0] * (VALUES - len(numbers))
        self._recorder.event("interventions", self._data.time, kind, target, tuple(numbers), work)


def owners(addresses: "np.ndarray", indices: "np.ndarray") -> list[int]:
    """The joints that own these entries of qpos or qvel, by each joint's first address."""
    import numpy as np

    return [int(j) for j in np.unique(np.searchsorted(addresses, indices, side="right") - 1)]


def refresh(model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
    """Bring everything that derives from positions and velocities up to date."""
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

    from ..recording.derive import velocity_at

    linear = velocity_at(data.xipos, data.cvel, data.subtree_com[model.body_rootid])
    local = np.einsum("bji,bj->bi", data.ximat.reshape(-1, 3, 3), data.cvel[:, :3])
    return np.asarray((model.body_mass * (linear**2).sum(axis=1) + (model.body_inertia * local**2).sum(axis=1)) / 2)
