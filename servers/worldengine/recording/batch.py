"""Hold the raw engine numbers of consecutive rows: preallocated, filled by plain copies, turned into columns later."""

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from .bonds import bonds_of
from .columns import TABLES

if TYPE_CHECKING:
    import mujoco
    import numpy as np

PLAIN = (
    "qpos", "qvel", "act", "ctrl", "eq_active", "mocap_pos", "mocap_quat", "plastic", "energy", "actuator_force",
    "sensordata",
)  # fmt: skip
"""Arrays that are recorded as they are."""
FAR_M = 1e3
"""Larger distances are not looked for, m."""
TRANSLATIONS = 3
"""A weld has so many rows before those of its torque."""
LIMIT_TENDON = 4
"""mjCNSTR_LIMIT_TENDON."""
CONTACT_FIELDS = ("geom", "dist", "pos", "frame", "dim", "efc_address")


class Batch:
    """Buffers for `capacity` rows; B bodies without the world. `rows` counts the filled ones.

    `channels` are arrays from elsewhere, by column, recorded as they are once forces are computed.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        capacity: int,
        channels: "Mapping[str, np.ndarray] | None" = None,
    ) -> None:
        import mujoco
        import numpy as np

        self.capacity = capacity
        self._model = model
        self._speculative = bool(model.opt.enableflags & int(mujoco.mjtEnableBit.mjENBL_SPECULATIVE))
        self.rows = 0
        self.first_row = 0
        self.events: dict[str, list[Any]] = {name: [] for name in TABLES if name != "contacts"}
        self.later: dict[str, list[Any]] = {name: [] for name in (*self.events, "pushes")}
        self.time = np.empty(capacity)
        self.ncon = np.zeros(capacity, np.int32)
        self.nefc = np.zeros(capacity, np.int32)
        self.eq_residual = np.zeros((capacity, model.neq))
        self.eq_force = np.zeros((capacity, model.neq))
        self.eq_torque = np.zeros((capacity, model.neq))
        self._welds = model.eq_type == mujoco.mjtEq.mjEQ_WELD
        # Those rows act on half the rotation (a quaternion's vector part) times the weld's torque scale, `data[10]`.
        self._turning = 0.5 * model.eq_data[:, 10]
        self.eq_stress = np.zeros((capacity, model.neq))
        self.bonds = bonds_of(model)
        self.tendon_limit = np.zeros((capacity, model.ntendon))
        self.carries = bool(model.neq or model.ntendon)
        # Views into MjData stay valid for its lifetime, except those of the contact and constraint arena.
        self._buffers: dict[str, np.ndarray] = {}
        self._momentum = mujoco.mj_subtreeVel
        self._before = self._mirror(
            {
                **{name: getattr(data, name) for name in PLAIN if name not in ("actuator_force", "sensordata")},
                "xpos": data.xpos[1:],
                "xquat": data.xquat[1:],
                "xipos": data.xipos[1:],
                "cvel": data.cvel[1:],
                "subtree_com": data.subtree_com,
                "ten_length": data.ten_length,
                "ten_velocity": data.ten_velocity,
                "linvel": data.subtree_linvel[0],
                "angmom": data.subtree_angmom[0],
            }
        )
        self.controls = (self._buffers["ctrl"], data.ctrl) if data.ctrl.size else None
        self._after = self._mirror(
            {
                "actuator_force": data.actuator_force,
                "sensordata": data.sensordata,
                "solver_niter": data.solver_niter,
                **(channels or {}),
            }
        )
        self.nisland = np.zeros(capacity, np.int32)
        fields = (*CONTACT_FIELDS, "friction") if model.opt.cone == mujoco.mjtCone.mjCONE_PYRAMIDAL else CONTACT_FIELDS
        self.contact_fields = fields
        self.contact: dict[str, np.ndarray] = {}
        self.contact_count = 0
        self.efc_force = np.empty(4096)
        self.efc_count = 0

    def _mirror(self, sources: "dict[str, np.ndarray]") -> "list[tuple[np.ndarray, np.ndarray]]":
        """(buffer, source) of every source that has numbers; all buffers can be found by name."""
        import numpy as np

        pairs = []
        for name, source in sources.items():
            self._buffers[name] = np.empty((self.capacity, *source.shape), source.dtype)
            if source.size:
                pairs.append((self._buffers[name], source))
        return pairs

    def buffer(self, name: str) -> "np.ndarray":
        """The filled rows of a mirrored array."""
        return self._buffers[name][: self.rows]

    def copy_before(self, data: "mujoco.MjData") -> None:
        """Copy what derives from positions and velocities into the row that is open."""
        self._momentum(self._model, data)
        self.time[self.rows] = data.time
        for buffer, source in self._before:
            buffer[self.rows] = source

    def copy_after(self, data: "mujoco.MjData") -> None:
        """Copy what derives from forces, and end the row."""
        row = self.rows
        for buffer, source in self._after:
            buffer[row] = source
        self.nisland[row] = data.nisland
        self.add_contacts(row, data)
        if self.carries:
            self.add_loads(row, data)
        self.rows = row + 1

    def add_contacts(self, row: int, data: "mujoco.MjData") -> None:
        """Append this step's contacts and constraint forces (strided copies, no loop over contacts)."""
        count = data.ncon
        self.ncon[row] = count
        if not count:
            self.nefc[row] = 0
            return
        contact = data.contact
        start, end = self.contact_count, self.contact_count + count
        buffers = self.contact
        if not buffers or end > len(buffers["dist"]):
            self._grow_contacts(contact, end)
        for name in self.contact_fields:
            buffers[name][start:end] = getattr(contact, name)
        if self._speculative:
            buffers["dist"][start:end] = true_distances(self._model, data, contact)
        self.contact_count = end
        forces = data.efc_force
        start, end = self.efc_count, self.efc_count + len(forces)
        if end >= len(self.efc_force):  # one more than needed: `derive` reads a zero there
            self.efc_force = _enlarged(self.efc_force, end + 1)
        self.efc_force[start:end] = forces
        self.nefc[row] = len(forces)
        self.efc_count = end

    def add_loads(self, row: int, data: "mujoco.MjData") -> None:
        """Write each equality's violation (NaN while it is off), force and torque, and the force of each tendon's limit.

        A weld has three rows of force, N, and three of torque, N m, which are not added up.
        """
        import numpy as np

        count, equalities, tendons = data.ne, self.eq_residual.shape[1], self.tendon_limit.shape[1]
        force = data.efc_force
        if equalities:
            owners = data.efc_id[:count]
            squares = np.bincount(owners, data.efc_pos[:count] ** 2, minlength=equalities)
            self.eq_residual[row] = np.where(data.eq_active, np.sqrt(squares), np.nan)
            loads = force[:count] ** 2
            if self._welds.any():
                turning = self._welds[owners] & (np.arange(count) - np.searchsorted(owners, owners) >= TRANSLATIONS)
                torque = np.sqrt(np.bincount(owners, loads * turning, minlength=equalities))
                self.eq_torque[row] = torque * self._turning
                loads = loads * ~turning
            self.eq_force[row] = np.sqrt(np.bincount(owners, loads, minlength=equalities))
            if self.bonds:
                from worldkit.breaking.letting_go import stresses

                self.eq_stress[row, self.bonds.equality] = stresses(self.bonds, data)
        if tendons:
            limits = slice(count + data.nf, count + data.nf + data.nl)
            mine = data.efc_type[limits] == LIMIT_TENDON
            self.tendon_limit[row] = np.bincount(data.efc_id[limits][mine], force[limits][mine], minlength=tendons)

    def _grow_contacts(self, contact: Any, needed: int) -> None:
        import numpy as np

        for name in self.contact_fields:
            sample = getattr(contact, name)
            old = self.contact.get(name)
            if old is None:
                old = np.empty((0, *sample.shape[1:]), sample.dtype)
            self.contact[name] = _enlarged(old, needed)

    def clear(self, first_row: int) -> None:
        """Empty the buffers for reuse."""
        self.rows = self.contact_count = self.efc_count = 0
        self.first_row = first_row
        for events in (*self.events.values(), *self.later.values()):
            events.clear()


def true_distances(model: "mujoco.MjModel", data: "mujoco.MjData", contact: Any) -> "np.ndarray":
    """(C,) m: distances between geoms, true where the engine's own are the solver's stand-ins.

    A speculative contact is made before the geoms touch, with a distance that makes the solver stop them in time (manual,
    "Effective contact distance"): it would read as a deep penetration. Only geoms that travel further in a step than
    they are thick can have one; if such a pair does not overlap, its distance is measured.
    """
    import numpy as np

    from .derive import velocity_at
    from .gaps import distance as apart

    distance, pairs = contact.dist.copy(), contact.geom
    known = pairs >= 0
    geoms = np.unique(pairs[known])
    body = model.geom_bodyid[geoms]
    cvel = data.cvel[body]
    speed = velocity_at(data.geom_xpos[geoms], cvel, data.subtree_com[model.body_rootid[body]])
    reach = np.linalg.norm(speed, axis=1) + np.linalg.norm(cvel[:, :3], axis=1) * model.geom_rbound[geoms]
    fast = np.zeros(model.ngeom, bool)
    fast[geoms] = reach * model.opt.timestep > model.geom_aabb.reshape(-1, 6)[geoms, 3:].min(axis=1)
    for i in np.flatnonzero((known & fast[np.maximum(pairs, 0)]).any(axis=1) & known.all(axis=1)):
        gap = apart(model, data, int(pairs[i, 0]), int(pairs[i, 1]), FAR_M)
        if gap > 0:
            distance[i] = gap
    return distance


def _enlarged(old: "np.ndarray", needed: int) -> "np.ndarray":
    """A copy with room for at least `needed` entries, doubled in size."""
    import numpy as np

    grown = np.empty((max(needed, 2 * len(old), 256), *old.shape[1:]), old.dtype)
    grown[: len(old)] = old
    return grown
