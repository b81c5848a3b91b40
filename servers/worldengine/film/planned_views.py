"""The film of the plan's cameras as a row of frames that any process may draw: through each camera in turn, then the next moment."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..recording.replay import Replay

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.stored import Recording
    from .drawn_frames import Frames


class PlannedViews:
    """Frame `place` shows the recorded row `rows[place // len(names)]` through camera `names[place % len(names)]`.

    Args:
        model: with its cameras aimed.
        recording: of that model.
        names: the cameras.
        rows: of the recording, (moments,).
        frames: what draws.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        recording: "Recording",
        names: Sequence[str],
        rows: "np.ndarray",
        frames: "Frames",
    ) -> None:
        self._model, self._names, self._rows, self.frames = model, names, rows, frames
        self._replay, self._shown = Replay(model, recording), -1

    def __len__(self) -> int:
        return len(self._rows) * len(self._names)

    def name(self, place: int) -> str:
        """The camera of a frame."""
        return self._names[place % len(self._names)]

    def picture(self, place: int) -> "np.ndarray":
        """A frame: uint8 (height, width, 3)."""
        from worldkit import cameras

        moment = place // len(self._names)
        if moment != self._shown:
            self._data, self._shown = self._replay.show(int(self._rows[moment])), moment
            cameras.track(self._model, self._data)
        return self.frames.image(self._data, self.name(place), quality="video")

    def hidden(self) -> list[str]:
        """Nothing is known of what covers what: a plan's camera has no subject of its own."""
        return []
