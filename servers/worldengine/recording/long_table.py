"""Read a table of which there may be more than one wants to hold: the points of an author's law come to gigabytes in a minute.

Its batches are unpacked one after another, or one of them when it is asked for; what lies packed in the file stays there.
"""

from collections.abc import Iterator
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import RecordingError

from . import stream_files
from .columns import LATER

if TYPE_CHECKING:
    import numpy as np
    import pyarrow as pa

KEPT = 2
"""So many batches stay unpacked: two instants that a picture lies between are in two of them at the most."""


class OneMedium:
    """Places and colours of one medium in a file of `media`, instant after instant, each unpacked when it is asked for.

    Args:
        path: the file.
        number: of the medium.
        count: points of it, in each instant.
    """

    def __init__(self, path: Path, number: int, count: int) -> None:
        import numpy as np

        self._path, self._number, self._count = path, number, count
        self._unpacked: dict[int, tuple[np.ndarray, np.ndarray]] = {}
        self.coloured = False
        """Whether any point has a colour."""
        ends, steps = [0], [np.empty(0, np.int32)]
        for batch in _each(path):
            mine = self._mine(batch)
            ends.append(ends[-1] + int(mine.sum()))
            steps.append(np.unique(_column(batch, "step")[mine]))
            self.coloured |= int(_column(batch, "colour")[mine].max(initial=-1)) >= 0
        self._ends = np.array(ends)
        self.rows = ends[-1]
        """All of its rows, those of an instant that is torn, too."""
        self.steps = np.unique(np.concatenate(steps))
        """(F,) of its instants, rising."""

    def __len__(self) -> int:
        """Whole instants."""
        return self.rows // max(1, self._count)

    def places(self, instant: int) -> "np.ndarray":
        """(n, 3) m."""
        import numpy as np

        return np.concatenate([self._at(batch)[0][rows] for batch, rows in self._where(instant)])

    def colours(self, instant: int) -> "np.ndarray":
        """(n,) colours, each as one number."""
        import numpy as np

        return np.concatenate([self._at(batch)[1][rows] for batch, rows in self._where(instant)])

    def _where(self, instant: int) -> Iterator[tuple[int, slice]]:
        """The batches in which an instant lies, and its rows among this medium's in each."""
        import numpy as np

        first, last = instant * self._count, (instant + 1) * self._count
        for batch in range(int(np.searchsorted(self._ends, first, side="right")) - 1, len(self._ends) - 1):
            begins, ends = int(self._ends[batch]), int(self._ends[batch + 1])
            if begins >= last:
                return
            yield batch, slice(max(first, begins) - begins, min(last, ends) - begins)

    def _at(self, number: int) -> "tuple[np.ndarray, np.ndarray]":
        """Places and colours of this medium in a batch."""
        import pyarrow as pa

        if number not in self._unpacked:
            while len(self._unpacked) >= KEPT:
                del self._unpacked[next(iter(self._unpacked))]
            schema, messages = self._messages
            batch = pa.ipc.read_record_batch(messages[number], schema)
            mine = self._mine(batch)
            self._unpacked[number] = _column(batch, "place").reshape(-1, 3)[mine], _column(batch, "colour")[mine]
        return self._unpacked[number]

    @cached_property
    def _messages(self) -> "tuple[pa.Schema, list[pa.Message]]":
        """The file's schema, and its batches as they lie there, packed."""
        import pyarrow as pa

        reader = pa.ipc.MessageReader.open_stream(pa.memory_map(str(self._path)))
        schema = pa.ipc.read_schema(reader.read_next_message())
        found: list[pa.Message] = []
        while len(found) < len(self._ends) - 1:  # what follows is torn
            found.append(reader.read_next_message())
        return schema, found

    def _mine(self, batch: "pa.RecordBatch") -> "np.ndarray":
        return _column(batch, "medium") == self._number


def rows(path: Path, media: int | None = None) -> int:
    """How many rows a file of `media` has; of the first so many media, where that is given."""
    return sum(
        int((_column(batch, "medium") < media).sum()) if media is not None else len(batch) for batch in _each(path)
    )


def hashed(digest: Any, path: Path, told: str, count: int, media: int | None = None) -> None:
    """Add to a hash what is `told` as `media.NAME` or `media NAME`: its `rows`, which were counted, and the bytes of that column."""
    digest.update(f"\n{told} {count} ".encode())
    for batch in _each(path):
        numbers = _column(batch, told[len("media.") :]).reshape(len(batch), -1)
        digest.update((numbers[_column(batch, "medium") < media] if media is not None else numbers).tobytes())


def _each(path: Path) -> "Iterator[pa.RecordBatch]":
    return (batch for batch, _ in stream_files.each(path, torn=True))


def _column(batch: "pa.RecordBatch", name: str) -> Any:
    """The numbers of a column; a row's one after another."""
    import numpy as np

    if name not in batch.schema.names:
        if (later := LATER.get(("media", name))) is not None:
            return np.full(len(batch), later, np.int32)
        cause = f"it has no column {name}, which an earlier version did not record"
        raise RecordingError(cause, "media.arrows", "run the physics pass again")
    held = batch[name]
    return (held.flatten() if name == "place" else held).to_numpy(zero_copy_only=True)
