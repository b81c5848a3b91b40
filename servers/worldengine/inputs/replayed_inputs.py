"""Drive a simulation by its inputs, step by step: ask for answers, write them, keep the ledger.

With latency 0 the world waits for the answer to the state that it shows, and meanwhile makes its row of the recording. With
latency 1 the answer to one question takes effect at the next, and both processes work at once.
"""

from collections.abc import Callable
from typing import TYPE_CHECKING

from .ledger import Ledger
from .ports import Ports
from .replies import Answers
from .strict_stream import Recorded

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.record import Recorder
    from ..recording.stored import Recording, Replayable
    from ..variants.holding import Shares
    from .author_link import Voice


class Drive:
    """Drives a world by declared inputs, whoever answers; see `Asked` and `Replayed`."""

    def __init__(
        self, model: "mujoco.MjModel", data: "mujoco.MjData", ports: Ports, shares: "Shares | None" = None
    ) -> None:
        self._model, self._data, self.ports = model, data, ports
        self.answers = Answers(model, data, ports, shares)

    def record(self, recorder: "Recorder") -> None:
        """Keep the ledger in this recording; must be called before the first step."""
        self._recorder = recorder
        self._ledger = Ledger(self._model, self._data, self.ports, recorder)

    def act(self, step: int, row: Callable[[], object] | None) -> None:
        """Apply the inputs of a step, with everything that derives from positions and velocities up to date.

        Args:
            step: number of the step that begins.
            row: makes the first half of a row of the recording; None when the step has no row.
        """
        raise NotImplementedError

    def _apply(self, step: int) -> bool:
        """Write the latest answer; returns whether it changed the state."""
        answers, ledger = self.answers, self._ledger
        if not answers.news:  # the inputs stand as they were written
            ledger.messages.step = step
            return False
        self._keep(step)
        if not answers.acts_once:
            answers.push()
            return False
        changes = answers.changes
        if changes:
            ledger.about_to_change()
        answers.push()
        for edit in answers.edit():
            ledger.edited(edit)
        if changes:
            answers.change()
            ledger.changed()
        return changes

    def _keep(self, step: int) -> None:
        """Record the answer that acts from this step on."""
        self._ledger.messages.add(step, self.answers.vector)

    def reacted(self) -> None:
        """Note the forces, which are computed now, before the step ends."""
        self._ledger.reacted()

    def _tell(self, step: int, numbers: "np.ndarray | None") -> None:
        """Record what the author's laws told at a step."""
        if numbers is not None and self.ports.media is not None:
            self.ports.media.keep(self._recorder, step, numbers)

    def finish(self, steps: int) -> None:
        """Finish the ledger once the velocities of the last state, after so many steps, are computed."""
        self._ledger.pushes.measure()
        self._ledger.finish()
        media = self.ports.media
        if media is not None and media.end is not None:
            self._tell(steps, self._last(steps))

    def _last(self, steps: int) -> "np.ndarray | None":
        """What the laws tell once nothing acts any more: what acted after their last sums would be counted nowhere."""
        raise NotImplementedError

    def close(self) -> None:
        """Nobody will be asked again."""


class Asked(Drive):
    """Asks an author.

    Args:
        model, data: the world, as it will be simulated.
        ports: the open inputs.
        voice: the link to the author.
        every: steps from one question to the next.
        latency: 0 or 1 questions from the state shown to the step that the answer acts on.
        shares: the shares of the inputs that a variant leaves.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: Ports,
        voice: "Voice",
        every: int = 1,
        latency: int = 0,
        shares: "Shares | None" = None,
    ) -> None:
        super().__init__(model, data, ports, shares)
        self._voice, self._every, self._latency = voice, every, latency
        self._waiting, self._media = False, ports.media

    def act(self, step: int, row: Callable[[], object] | None) -> None:
        """Ask, make the row meanwhile, and apply the answer."""
        pushes, answers, voice = self._ledger.pushes, self.answers, self._voice
        asks, latency = step % self._every == 0, self._latency
        heard = asks and (not latency or self._waiting)
        if asks:
            if latency and heard:
                voice.hear()
                answers.read(voice.message)
            answers.shown(voice.ask())
            voice.go()
            self._waiting = True
        pushes.measure()
        if row is not None:
            row()
        if heard:
            if not latency:
                voice.hear()
                answers.read(voice.message)
                if self._media is not None and self._media.due(step // self._every):
                    self._tell(step, self._media.read(voice.media))
            changed = self._apply(step)
            if row is not None:
                row() if changed else self._recorder.inputs_again()
        pushes.note()

    def _last(self, steps: int) -> "np.ndarray | None":  # noqa: ARG002 (the protocol's)
        """Ask once more, for the sums alone."""
        self.answers.shown(self._voice.ask())
        self._voice.go()
        self._voice.hear()
        return self.ports.media.read(self._voice.media) if self.ports.media else None

    def close(self) -> None:
        """Nobody will be asked again."""
        self._voice.close()


class Replayed(Drive):
    """Drives a world by the answers of a recording; see `Recorded`, which refuses a stream that makes no sense."""

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        ports: Ports,
        recording: "Recording | Replayable",
        steps: int,
        every: int = 1,
    ) -> None:
        super().__init__(model, data, ports)
        self._folder = recording.folder
        self._recorded = Recorded(recording, model, ports, steps, every)

    def record(self, recorder: "Recorder") -> None:
        """Keep the ledger in this recording, and in it the inputs as they were given."""
        super().record(recorder)
        recorder.as_given("inputs", self._folder)

    def _keep(self, step: int) -> None:
        """It is recorded already."""
        self._ledger.messages.step = step

    def act(self, step: int, row: Callable[[], object] | None) -> None:
        """Apply what the recording holds for this step."""
        self._ledger.pushes.measure()
        if self._recorded.speaks(step):
            self.answers.replay(*self._recorded.answer(step))
            self._apply(step)
        if self.ports.media is not None:
            self._tell(step, self._recorded.told(step))
        if row is not None:
            row()
        self._ledger.pushes.note()

    def _last(self, steps: int) -> "np.ndarray | None":
        """What was recorded of the end."""
        return self._recorded.told(steps)
