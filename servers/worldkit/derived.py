"""Noticing that a program writes what the engine has derived, rather than the state it derived it from.

The second half of a step reads forces, inertias and contacts that the first half computed. A `control` that edits
`qfrc_bias` cancels gravity without a force being applied; one that edits `data.contact` changes friction without a
parameter being edited. The forces are compared at every step (they are a few contiguous kilobytes); everything else
that the second half reads is compared at every `SAMPLE`-th, since it is computed anew at every step and an edit that is
to matter has to be made again and again.
"""

from typing import TYPE_CHECKING

from .watch import comparison, span

if TYPE_CHECKING:
    import mujoco
    import numpy as np

SAMPLE = 32
"""Steps from one look at everything to the next."""
FORCES = (
    "qfrc_bias", "qfrc_spring", "qfrc_damper", "qfrc_gravcomp", "qfrc_fluid", "qfrc_adhesion", "qfrc_passive",
)  # fmt: skip
"""Neighbours in memory, computed from positions and velocities."""
READ = (
    "xpos", "xquat", "xmat", "xipos", "ximat", "subtree_com", "cdof", "cinert", "crb", "M", "ten_J", "ten_length",
    "ten_velocity", "actuator_length", "actuator_moment", "actuator_velocity", "cvel", "cdof_dot", "efc_J", "efc_pos",
    "efc_margin", "efc_frictionloss", "efc_KBIP", "efc_D", "efc_R", "efc_aref",
)  # fmt: skip
"""What else the second half of a step reads."""
CONTACT = ("dist", "frame", "friction", "solref", "solreffriction", "solimp", "mu")
"""Fields of the contacts that it reads."""


class Derived:
    """Remembers what is derived (`remember`), and tells what was written to it since."""

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        import numpy as np

        self._data = data
        self._live = span([getattr(data, name) for name in FORCES])
        self._copy = self._live.copy()
        self._differs = comparison(self._live, self._copy) if model.nv else bool
        self._step = -1
        self._before: dict[str, np.ndarray] = {}
        # Where joints are compensated by their actuators, the compensation is no passive force.
        by_actuator = np.array(model.jnt_actgravcomp, bool)[model.dof_jntid] if model.nv else np.zeros(0, bool)
        self._passive_gravcomp = ~by_actuator

    def remember(self) -> None:
        """Before anything may interfere."""
        self._copy[:] = self._live
        self._step += 1
        if self._step % SAMPLE == 0:
            self._before = self._everything()

    def force(self) -> "np.ndarray | None":
        """(nv,) generalised force that was slipped into the derived forces, or None."""
        if not self._differs():
            return None
        start = self._data.qfrc_bias.__array_interface__["data"][0]

        def old(name: str) -> "np.ndarray":
            live = getattr(self._data, name)
            offset = live.__array_interface__["data"][0] - start
            return self._copy[offset : offset + live.nbytes].view(live.dtype)

        data = self._data
        added = (data.qfrc_passive - old("qfrc_passive")) - (data.qfrc_bias - old("qfrc_bias"))
        return added if added.any() else None

    def others(self) -> "list[tuple[str, np.ndarray]]":
        """(name, first new values) of everything else that was written; looks every `SAMPLE`-th step only."""
        import numpy as np

        if self._step % SAMPLE:
            return []
        found = []
        for name, now in self._everything().items():
            old = self._before[name]
            if old.shape == now.shape and old.tobytes() != now.tobytes():
                found.append((name, now.reshape(-1)[np.flatnonzero(old.reshape(-1) != now.reshape(-1))]))
        return found

    def called_back(self) -> "np.ndarray | None":
        """(nv,) generalised force of a passive-force callback: what the engine's own passive forces do not add up to."""
        import numpy as np

        data = self._data
        own = data.qfrc_spring + data.qfrc_damper + data.qfrc_fluid + data.qfrc_adhesion
        own += np.where(self._passive_gravcomp, data.qfrc_gravcomp, 0.0)
        extra = data.qfrc_passive - own
        scale = np.abs(own).max(initial=0.0) + np.abs(data.qfrc_passive).max(initial=0.0)
        extra[np.abs(extra) <= 1e-12 * scale] = 0.0
        return extra if extra.any() else None

    def _everything(self) -> "dict[str, np.ndarray]":
        data = self._data
        found = {name: getattr(data, name).copy() for name in READ}
        if data.ncon:
            contact = data.contact
            found |= {f"contact.{name}": getattr(contact, name).copy() for name in CONTACT}
        return found
