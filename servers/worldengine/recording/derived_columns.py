"""The columns of a recording that a batch of raw rows makes, all at once: what the recorder writes and an episode is judged by."""

from typing import TYPE_CHECKING

from . import derive
from .batch import PLAIN, Batch

if TYPE_CHECKING:
    import mujoco
    import numpy as np


class Derived:
    """Makes columns (`columns.state_columns`, `columns.CONTACT_COLUMNS`) of batches of one model.

    Args:
        model: the world.
        channels: names of the columns from elsewhere that the batches hold as they are.
    """

    def __init__(self, model: "mujoco.MjModel", channels: tuple[str, ...] = ()) -> None:
        import numpy as np

        self._model, self._channels = model, channels
        self._mass = np.where(model.body_treeid[1:] >= 0, model.body_mass[1:], 0.0)
        self._root = model.body_rootid[1:]

    def state(self, batch: Batch) -> "dict[str, np.ndarray]":
        """The state columns of a batch, contiguous."""
        import numpy as np

        n = batch.rows
        columns = {name: batch.buffer(name) for name in (*PLAIN, *self._channels)}
        columns |= {"time": batch.time[:n], "ncon": batch.ncon[:n], "eq_residual": batch.eq_residual[:n]}
        columns |= {
            "eq_force": batch.eq_force[:n],
            "eq_torque": batch.eq_torque[:n],
            "tendon_length": batch.buffer("ten_length"),
        }
        if batch.bonds:
            columns["eq_stress"] = batch.eq_stress[:n]
        columns["tendon_force"] = derive.tension(
            self._model, columns["tendon_length"], batch.buffer("ten_velocity"), batch.tendon_limit[:n]
        )
        iterations, islands = batch.buffer("solver_niter"), np.maximum(batch.nisland[:n], 1)
        used = np.arange(iterations.shape[1]) < islands[:, None]
        columns["solver_niter"] = np.where(used, iterations, 0).max(axis=1).astype(np.int32)
        momentum = batch.buffer("linvel") * float(self._model.body_subtreemass[0])
        columns |= {"linmom": momentum, "angmom": batch.buffer("angmom")}
        columns |= {"pos": batch.buffer("xpos"), "quat": batch.buffer("xquat")}
        if len(self._root):
            cvel, trees = batch.buffer("cvel"), batch.buffer("subtree_com")
            columns["angvel"] = np.ascontiguousarray(cvel[..., :3])
            columns["linvel"] = derive.velocity_at(columns["pos"], cvel, trees[:, self._root])
            if moving := float(self._mass.sum()):
                # The engine's angular momentum refers to the centre of everything, with the scenery.
                own = np.einsum("nbi,b->ni", batch.buffer("xipos"), self._mass) / moving
                columns["angmom"] = derive.angular_momentum(columns["angmom"], trees[:, 0], own, momentum)
        return columns

    def contacts(self, batch: Batch) -> "dict[str, np.ndarray]":
        """The contact columns of a batch."""
        import numpy as np

        n, count = batch.rows, batch.contact_count
        raw = {name: buffer[:count] for name, buffer in batch.contact.items()}
        per_row = batch.ncon[:n]
        first = np.cumsum(batch.nefc[:n]) - batch.nefc[:n]
        address = raw["efc_address"]
        address = np.where(address >= 0, address + np.repeat(first, per_row), -1)
        batch.efc_force[batch.efc_count] = 0.0
        forces = batch.efc_force[: batch.efc_count + 1]
        normal_force, force = derive.contact_forces(forces, address, raw["dim"], raw.get("friction"), raw["frame"])
        return {
            "row": np.repeat(np.arange(batch.first_row, batch.first_row + n, dtype=np.int32), per_row),
            "geom1": np.ascontiguousarray(raw["geom"][:, 0]),
            "geom2": np.ascontiguousarray(raw["geom"][:, 1]),
            "depth_m": -raw["dist"],
            "normal_force": normal_force,
            "force": force,
            "position": raw["pos"],
            "normal": np.ascontiguousarray(raw["frame"][:, :3]),
        }
