"""Remembering the state at one moment of a step, so that what was written to it since can be told.

Positions, velocities, inputs and mocap poses are neighbours in the engine's memory, so remembering them is one copy and
asking whether anything was written is one comparison of memory. Only when something differs are the parts looked at one
by one, as the engine's own state vectors (`mj_setState` takes `old`).
"""

from typing import TYPE_CHECKING

from .watch import comparison, span

if TYPE_CHECKING:
    import mujoco

PARTS = (
    "TIME", "QPOS", "QVEL", "ACT", "CTRL", "QFRC_APPLIED", "XFRC_APPLIED", "EQ_ACTIVE", "MOCAP_POS", "MOCAP_QUAT",
    "PLASTIC",
)  # fmt: skip
"""Components of the engine's state (`mjSTATE_…`), of which a program may write any."""
INPUTS = ("ctrl", "qfrc_applied", "xfrc_applied")
"""What pushes while it is not zero."""


class Snapshot:
    """`remember`, then `changed` and `pushing`.

    `old` and `new` are state vectors, `part` says where each component lies in them; both are up to date after
    `changed()` or `pushing()` said yes.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
        import mujoco
        import numpy as np

        self._model, self._data = model, data
        self.signature, offset = 0, 0
        self.part: dict[str, slice] = {}
        self._arrays: dict[str, np.ndarray] = {}
        for name in PARTS:
            bit = int(getattr(mujoco.mjtState, f"mjSTATE_{name}"))
            self.signature |= bit
            width = mujoco.mj_stateSize(model, bit)
            self.part[name] = slice(offset, offset + width)
            offset += width
            if name != "TIME" and width:
                self._arrays[name] = getattr(data, name.lower())
        self.old, self.new = np.zeros(offset), np.zeros(offset)
        self._time = 0.0
        placed = sorted(self._arrays.values(), key=lambda array: int(array.__array_interface__["data"][0]))
        self._live = span(placed) if placed else np.zeros(0, np.uint8)
        self._copy = self._live.copy()
        self._differs = comparison(self._live, self._copy) if placed else bool
        inputs = [array for name in INPUTS if (array := getattr(data, name)).size]
        self._pushing = comparison(span(inputs), np.zeros(span(inputs).size, np.uint8)) if inputs else bool
        self._pushed = False

    def remember(self) -> None:
        """Before anything may interfere."""
        self._copy[:] = self._live
        self._time = self._data.time
        self._pushed = self._pushing()

    def changed(self) -> bool:
        """Whether anything was written since; what the engine keeps between its states for itself does not count."""
        if not self._differs() and self._time == self._data.time:
            return False
        self._fill()
        return bool(self.old.tobytes() != self.new.tobytes())

    def pushing(self) -> bool:
        """Whether any control or applied force is not zero, or was not when it was remembered."""
        if not (self._pushed or self._pushing()):
            return False
        self._fill()
        return True

    def _fill(self) -> None:
        import mujoco

        mujoco.mj_getState(self._model, self._data, self.new, self.signature)
        start = self._live.__array_interface__["data"][0]
        self.old[self.part["TIME"]] = self._time
        for name, array in self._arrays.items():
            offset = array.__array_interface__["data"][0] - start
            self.old[self.part[name]] = self._copy[offset : offset + array.nbytes].view(array.dtype).reshape(-1)
