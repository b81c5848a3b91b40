"""Drive a world by somebody's commands; what else is declared acts as a recording says, at the same steps, as far as that goes."""

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

from .ledger import refresh
from .ports import Ports
from .replayed_inputs import Drive
from .strict_stream import Recorded

if TYPE_CHECKING:
    import mujoco

    from worldkit.model_arrays import Edit

    from .commands import Console


class Operated(Drive):
    """Drives a world by the commands that a console holds.

    Its inputs stand in the recording as those of a program do, so a replay needs neither the console nor who spoke to it. The work
    that pushes do is not reckoned here, where time is short: the replay does that.

    Args:
        model, data: the world, as it will be simulated.
        ports: the open inputs.
        console: what is commanded now.
        every: steps from one question to the next.
        beside: what was recorded of the other inputs; None where nothing was.
        until: the recording's steps; afterwards pushes are zero.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: Ports,
        console: "Console",
        every: int = 1,
        beside: Recorded | None = None,
        until: int = 0,
    ) -> None:
        import numpy as np

        super().__init__(model, data, ports)
        self._console, self._every, self._beside, self._until = console, every, beside, until
        self._controls = np.array(ports.entries.get("ctrl", []), int)
        self._vector = np.full(ports.width, np.nan)
        self._vector[: ports.width - len(self.answers.changing)] = 0.0
        self._written = b""

    def act(self, step: int, row: Callable[[], object] | None) -> None:
        """Apply what is commanded now."""
        if step % self._every == 0:
            self._ask(step)
            self._apply(step)
        if row is not None:
            row()

    def _apply(self, step: int) -> bool:
        answers, ledger = self.answers, self._ledger
        if not answers.news:
            return False
        self._keep(step)
        answers.push()
        for edit in answers.edit():
            ledger.edited(edit)
        if changes := answers.changes:
            answers.change()
            refresh(self._model, self._data)
        return changes

    def reacted(self) -> None:
        """Note nothing."""

    def finish(self, steps: int) -> None:  # noqa: ARG002 (the protocol's)
        """Hand over the last answers."""
        self._ledger.messages.flush()

    def _ask(self, step: int) -> None:
        edits: list[Edit] = []
        once, width = False, len(self._controls)
        lasting = len(self._vector) - len(self.answers.changing)
        if self._beside is not None and step < self._until:
            if once := self._beside.speaks(step):
                others, edits = self._beside.answer(step)
                self._vector[:] = others
        elif self._beside is not None:
            self._vector[width:lasting] = 0.0
        if not once:
            self._vector[lasting:] = math.nan
        self._console.write(self._model, self._data)
        self._vector[:width] = self._data.ctrl[self._controls]
        lasts = self._vector[:lasting].tobytes()
        if edits or once or lasts != self._written:
            self.answers.replay(self._vector, edits)
            self._written = lasts
        else:
            self.answers.news = False
