"""Keep the stream of answers as differences from one to the next, so that a world can be driven again without its author.

The table `inputs` has a row (step, entry, value) for every number of an answer that differs from the answer before, and for
every change of the state. Entries count through the ports in the order that `meta.json` lists them; the first answer is
compared with the inputs as the world begins. Parameters are in the table `edits`, by step.
"""

from typing import TYPE_CHECKING, Any

from worldkit.watch import Edit

if TYPE_CHECKING:
    import numpy as np

    from ..recording.record import Recorder
    from ..recording.stored import Recording, Replayable

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


class Recorded:
    """Gives the answers of a recording again.

    Args:
        recording: a recording with the same ports.
        lasting: so many of the first entries hold until they are written again; the others act once.
        width: the number of entries of an answer.
    """

    def __init__(self, recording: "Recording | Replayable", lasting: int, width: int) -> None:
        import numpy as np

        table, edits = recording.inputs, recording.edits
        self._step, self._entry, self._value = (np.asarray(table[name]) for name in ("step", "entry", "value"))
        self._edits = [np.asarray(edits[name]) for name in ("step", "array", "index", "value")]
        self._lasting, self._at, self._edit_at = lasting, 0, 0
        self.vector = np.full(width, np.nan)
        self.vector[:lasting] = 0.0

    def speaks(self, step: int) -> bool:
        """Whether an answer acts from this step on."""
        numbers = self._at < len(self._step) and self._step[self._at] == step
        return bool(numbers or (self._edit_at < len(self._edits[0]) and self._edits[0][self._edit_at] == step))

    def answer(self, step: int) -> "tuple[np.ndarray, list[Edit]]":
        """The vector and the edits that act from this step on; steps must come in their order."""
        import numpy as np

        self.vector[self._lasting :] = np.nan
        end = self._at
        while end < len(self._step) and self._step[end] == step:
            end += 1
        self.vector[self._entry[self._at : end]] = self._value[self._at : end]
        self._at = end
        edits: list[Edit] = []
        steps, arrays, indices, values = self._edits
        end = self._edit_at
        while end < len(steps) and steps[end] == step:
            end += 1
        mine = slice(self._edit_at, end)
        for name in dict.fromkeys(arrays[mine].tolist()):
            these = arrays[mine] == name
            edits.append(Edit(str(name), indices[mine][these].astype(np.intp), values[mine][these], looks_only=False))
        self._edit_at = end
        return self.vector, edits
