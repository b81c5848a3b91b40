"""Keep the stream of answers as differences from one to the next, so that a world can be driven again without its author.

The table `inputs` has a row (step, entry, value) for every number of an answer that differs from the answer before, and for
every change of the state. Entries count through the ports in the order that `meta.json` lists them; the first answer is
compared with the inputs as the world begins. Parameters are in the table `edits`, by step. `strict_stream` reads both.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import numpy as np

    from ..recording.record import Recorder

ROWS = 1024


class Messages:
    """Collects answers and hands over what is new in them, many at once.

    Args:
        recorder: of the simulation.
        lasting: so many of the first entries hold until they are written again.
    """

    def __init__(self, recorder: "Recorder", lasting: int) -> None:
        self._recorder, self._lasting = recorder, lasting
        self._vectors: list[Any] = []
        self._steps: list[int] = []
        self._last: Any = None
        self.step = 0
        """The step of the latest answer."""

    def add(self, step: int, vector: "np.ndarray") -> None:
        """Add an answer that acts from this step on."""
        self.step = step
        if len(vector):
            self._steps.append(step)
            self._vectors.append(vector.copy())
            if len(self._steps) == ROWS:
                self.flush()

    def flush(self) -> None:
        """Hand over the answers so far."""
        if not self._steps:
            return
        steps, vectors, last, lasting = self._steps, self._vectors, self._last, self._lasting
        self._last = vectors[-1]
        self._steps, self._vectors = [], []
        self._recorder.later("inputs", lambda: _news(steps, vectors, last, lasting))


def _news(steps: list[int], vectors: list[Any], last: Any, lasting: int) -> dict[str, Any]:
    """Rows of the table: lasting entries where they differ, entries that act once whenever they do."""
    import numpy as np

    answers = np.array(vectors)
    before = np.concatenate([(np.zeros_like(answers[0]) if last is None else last)[None], answers[:-1]])
    new = answers != before
    if last is None:
        new[0] = True
    new[:, lasting:] = ~np.isnan(answers[:, lasting:])
    at, entry = np.nonzero(new)
    return {
        "step": np.array(steps, np.int32)[at],
        "entry": entry.astype(np.int32),
        "value": answers[at, entry],
    }
