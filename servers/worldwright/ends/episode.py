"""The rows of an episode so far, in memory, as the motion that expectations measure.

A row is copied as the recorder copies it, in two halves around the forces (`worldengine.clock.simulate`), so the row of the
state that is shown now is whole only once its action has acted: a motion ends with the state before, until the episode ends.
"""

from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np

from worldengine.recording.batch import Batch
from worldengine.recording.columns import TABLES, state_columns
from worldengine.recording.derived_columns import Derived

from ..model.recording.trajectory_files import from_recording

if TYPE_CHECKING:
    import mujoco

    from ..model.recording.trajectory import Trajectory

SIZES = ("nq", "nv", "na", "nu", "nmocap", "neq", "ntendon", "nsensordata", "nplastic")


class Episode:
    """Keeps rows of one simulation.

    Args:
        model, data: the world, and what is stepped.
        meta: what a recording's `meta.json` says of the model (`worldengine.recording.describing.describe`).
        most: rows that an episode can have.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", meta: dict[str, Any], most: int) -> None:
        self._data, self._meta = data, meta
        self._batch, self._derived = Batch(model, data, most), Derived(model)
        sizes = {"bodies": model.nbody - 1, **{name: int(getattr(model, name)) for name in SIZES}}
        self._columns = state_columns(sizes, empty=True)

    def begin(self) -> None:
        """Forget all rows."""
        self._batch.clear(0)

    def before(self) -> None:
        """Copy what derives from positions and velocities, once the action is written."""
        self._batch.copy_before(self._data)

    def after(self) -> None:
        """Copy what derives from forces, and end the row."""
        self._batch.copy_after(self._data)

    def __len__(self) -> int:
        return self._batch.rows

    def motion(self) -> "Trajectory":
        """All whole rows. Nothing tells what acted, or how much work it did: what asks for that stays unknown."""
        from dataclasses import replace

        batch = self._batch
        state = self._derived.state(batch)
        empty = {c.name: np.zeros((batch.rows, *c.shape), c.dtype) for c in self._columns if not c.width}
        touches = self._derived.contacts(batch) if batch.contact_count else _no_rows("contacts")
        held = SimpleNamespace(
            **{name: np.array(values) for name, values in (empty | state).items()},
            folder="the episode so far",
            names=[body["name"] for body in self._meta["bodies"]],
            meta=self._meta,
            contacts=SimpleNamespace(**{name: np.array(values) for name, values in touches.items()}),
            **{name: SimpleNamespace(**_no_rows(name)) for name in ("interventions", "warnings", "edits")},
            overlaps=None,
            cameras=None,
            time_step=float(self._meta["time_step"]),
            complete=True,
            sha256="",
        )
        return replace(from_recording(held), interventions=None)


def _no_rows(table: str) -> dict[str, Any]:
    return {c.name: np.zeros((0, *c.shape), "U1" if c.dtype == "string" else c.dtype) for c in TABLES[table]}
