"""Show recorded states again: only poses are computed, no physics.

A row of a recording holds the whole state, so a picture of it needs the position stage of the engine up to and
including kinematics, cameras, lights, flexes and tendons (`mj_fwdKinematics`), and nothing beyond: no collision, no
forces, no `mj_step`.
"""

from collections.abc import Iterator
from typing import TYPE_CHECKING

from worldkit.errors import RecordingError

from .lain import Lain

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..solvers import Solver
    from .stored import Recording

STATE = ("qpos", "qvel", "act", "ctrl", "mocap_pos", "mocap_quat", "eq_active", "plastic")


class Replay:
    """Shows the rows of a recording in a model and its data.

    Args:
        model: the same world, built again; its arrays follow the recorded edits (colours, sizes, …).
        recording: the recording to show.

    Raises:
        RecordingError: the recording is of another world, or empty.
    """

    def __init__(self, model: "mujoco.MjModel", recording: "Recording") -> None:
        import mujoco

        check_same_world(model, recording)
        if not len(recording):
            raise RecordingError("the recording has no rows", str(recording.folder), "run the physics pass again")
        self.model, self.recording = model, recording
        self.data = mujoco.MjData(model)
        self._columns = [(getattr(self.data, name), getattr(recording, name)) for name in STATE]
        edits = recording.edits
        # Options like gravity or the time step do not show, so a replay leaves them.
        self._edits = [
            (int(row), str(array), int(index), float(value))
            for row, array, index, value in zip(edits.row, edits.array, edits.index, edits.value, strict=True)
            if not array.startswith("opt.")
        ]
        self._applied: list[tuple[np.ndarray, int, float]] = []
        self._shown = list(_shown(model, recording))
        moves = recording.meta.get("laws") or recording.meta.get("shown")
        self._media = Lain(model, recording) if moves else None

    def show(self, row: int) -> "mujoco.MjData":
        """The data at a recorded row, ready to be drawn."""
        import mujoco

        self._apply_edits(row)
        data = self.data
        data.time = self.recording.time[row]
        for live, recorded in self._columns:
            live[...] = recorded[row]
        mujoco.mj_fwdKinematics(self.model, data)
        for solver, geom, channels in self._shown:
            solver.show(self.model, data, geom, {name: values[row] for name, values in channels.items()})
        if self._media is not None:
            self._media.show(data)
        return data

    def _apply_edits(self, row: int) -> None:
        """Bring the model's arrays to their values at this row, forwards or backwards."""
        while self._applied and self._edits[len(self._applied) - 1][0] > row:
            flat, index, old = self._applied.pop()
            flat[index] = old
        while len(self._applied) < len(self._edits) and self._edits[len(self._applied)][0] <= row:
            _, array, index, value = self._edits[len(self._applied)]
            flat = getattr(self.model, array).reshape(-1)
            self._applied.append((flat, index, flat[index].item()))
            flat[index] = value


def _shown(model: "mujoco.MjModel", recording: "Recording") -> "Iterator[tuple[Solver, int, dict[str, np.ndarray]]]":
    """The solvers that are drawn, each with its geom and its channels."""
    from worldkit.naming import names

    from ..inputs.told_laws import told
    from ..solvers import Row, called, check

    rows = [Row.read(row) for row in recording.meta.get("solvers", ())]
    geoms = names(model, "geom", model.ngeom)
    moved = {row.shown_by for row in told(recording.meta, str(recording.folder), "shown")}
    for name, row in zip(called(rows), rows, strict=True):
        if row.shown_by and row.shown_by not in moved:
            if row.shown_by not in geoms:
                raise RecordingError(
                    f"the solver {row.solver} is to be shown by {row.shown_by!r}, which the world has not",
                    str(recording.folder),
                    "name a geom that is only drawn",
                )
            yield check(row), geoms.index(row.shown_by), recording.channels(name)


def check_same_world(model: "mujoco.MjModel", recording: "Recording") -> None:
    """Raise `RecordingError` unless the recording fits the model: same bodies, same coordinates."""
    from worldkit.naming import names

    place = str(recording.folder)
    remedy = "run the physics pass of this program first"
    bodies = tuple(names(model, "body", model.nbody)[1:])
    if bodies != recording.names:
        odd = sorted(set(bodies) ^ set(recording.names)) or ["their order"]
        raise RecordingError(f"the recording is of another world; they differ in {', '.join(odd[:5])}", place, remedy)
    for name, size in recording.meta["sizes"].items():
        if getattr(model, name) != size:
            raise RecordingError(
                f"the recording has {name} = {size}, this world has {getattr(model, name)}", place, remedy
            )


def frame_rows(time: "np.ndarray", fps: float) -> "np.ndarray":
    """The rows to show: frame k is the row nearest to k / fps after the first, for the whole duration."""
    import numpy as np

    duration = float(time[-1] - time[0])
    wanted = time[0] + np.arange(max(1, round(duration * fps))) / fps
    after = np.clip(np.searchsorted(time, wanted), 0, len(time) - 1)
    before = np.maximum(after - 1, 0)
    return np.where(np.abs(time[before] - wanted) <= np.abs(time[after] - wanted), before, after)
