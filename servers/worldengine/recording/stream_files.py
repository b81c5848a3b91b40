"""Open a stream file of Arrow's of which nothing is known: its size is bounded before anything of it is unpacked.

A few kilobytes of zstd hold gigabytes of zeros, a forged length asks for more memory than there is, a forged offset reads what
is not the file's. So the messages' own words are read first, which takes no memory: what packed buffers say they unpack to, summed
up, must stay below `MOST_BYTES`, which the recorder keeps to, too. Arrow unpacks no more than a buffer says. Then every batch is
validated in full, and whatever is wrong is one kind of error.

The words are flatbuffers (format: Arrow's `Message.fbs`): a table's field n is where the table's own list of offsets says.
"""

import struct
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING

from worldkit.errors import RecordingError

if TYPE_CHECKING:
    import pyarrow as pa

MOST_BYTES = 2 << 30
"""A packed table has no more than this, unpacked."""
REMEDY = "restore it as it was recorded, or record the world anew"
LESS = "ask the author less often (`control_every`), or declare fewer inputs"
OF_POINTS = "let what is drawn have fewer points, or the run be shorter"
REMEDIES = {"media": OF_POINTS, "balances": OF_POINTS}
"""By table, where `LESS` does not help: points and sums are due by the simulated time."""
SCHEMA, BATCH = 1, 3
"""MessageHeader: the kinds that our files have. Others (dictionaries) would be unpacked, too."""
Said = tuple["pa.RecordBatch", Mapping[bytes, bytes]]
Batches = list[Said]


def batches(path: Path, *, torn: bool = False, most: int = MOST_BYTES, rows: int | None = None) -> Batches:
    """All record batches of a file, arguments and errors as of `each`."""
    return list(each(path, torn=torn, most=most, rows=rows))


def each(path: Path, *, torn: bool = False, most: int = MOST_BYTES, rows: int | None = None) -> Iterator[Said]:
    """The record batches of a file, one after another, and what is said about each; none where there is no file.

    Args:
        path: the file.
        torn: a damaged tail ends the list, as the file of a process that was killed has one; without it, it is an error.
        most: bytes that its packed buffers may have in all, unpacked.
        rows: the most that it can have, where that is known.

    Raises:
        RecordingError: it is too large, or damaged.
    """
    import pyarrow as pa

    if not path.exists() or (torn and not path.stat().st_size):
        return
    reader = None
    while True:
        try:
            if reader is None:
                _bounded(path, most, rows, torn=torn)
                reader = pa.ipc.open_stream(pa.memory_map(str(path)))
            batch, said = reader.read_next_batch_with_custom_metadata()
            batch.validate(full=True)
            _ = batch.schema.names  # which may be no text
        except StopIteration:
            return
        except (pa.ArrowException, OSError, ValueError, MemoryError) as cause:
            if not torn:
                raise damaged(path, cause) from cause
            return
        yield batch, said or {}
        del batch  # else it is held while the next one is unpacked


def schema(path: Path) -> "pa.Schema | None":
    """The columns of a file; None where there is no file.

    Raises:
        RecordingError: it begins with none.
    """
    import pyarrow as pa

    if not path.exists():
        return None
    try:
        with pa.memory_map(str(path)) as file, pa.ipc.open_stream(file) as reader:
            return reader.schema
    except (pa.ArrowException, OSError, ValueError, MemoryError) as cause:
        raise damaged(path, cause) from cause


def damaged(path: Path, cause: object) -> RecordingError:
    """The error for a file that nobody wrote so."""
    return RecordingError(f"{path.name} is damaged: {(str(cause).splitlines() or [''])[0]}", str(path), REMEDY)


def _bounded(path: Path, most: int, rows: int | None, *, torn: bool) -> None:
    """Refuse a file that would unpack to more than `most` bytes or `rows` rows, by what its messages say."""
    import pyarrow as pa

    total = told = 0
    try:
        with pa.memory_map(str(path)) as file:
            for message in pa.ipc.MessageReader.open_stream(file):
                length, sizes = _unpacked(message.metadata, message.body)
                total, told = total + sum(sizes), told + length
                if total > most:
                    what = f"{path.name} unpacks to more than {most / 2**20:.0f} MiB, the most that is recorded"
                    raise RecordingError(what, str(path), LESS)
                if rows is not None and told > rows:
                    what = f"{path.name} has more than the {rows} rows that the run has room for"
                    raise RecordingError(what, str(path), REMEDY)
    except struct.error as cause:
        raise damaged(path, "a message is none of a table's") from cause
    except (pa.ArrowException, OSError):
        if not torn:
            raise  # what came before the tear is bounded, and no more is read


def _unpacked(words: "pa.Buffer", body: "pa.Buffer") -> tuple[int, list[int]]:
    """The rows of a message, and the bytes that each of its packed buffers says it unpacks to."""
    text = memoryview(words)
    message = _fields(text, _at(text, 0))
    kind, header = message(1), message(2)
    if kind is None or header is None or text[kind] not in (SCHEMA, BATCH):
        raise struct.error
    if text[kind] == SCHEMA:
        return 0, []
    batch = _fields(text, _at(text, header))
    length, buffers = batch(0), batch(2)
    rows = _number(text, "<q", length) if length is not None else 0
    if rows < 0:
        raise struct.error
    if batch(3) is None or buffers is None:  # it is not packed, and lies in the file as it is read
        return rows, []
    held, sizes = memoryview(body), []
    first = _at(text, buffers) + 4
    for n in range(_number(text, "<I", first - 4)):
        at, size = _number(text, "<q", first + 16 * n), _number(text, "<q", first + 16 * n + 8)
        if size:
            sizes.append(max(0, _number(held, "<q", at)))  # -1: this one lies there as it is read
    return rows, sizes


def _fields(text: memoryview, table: int) -> Callable[[int], int | None]:
    """Where the fields of a flatbuffer's table lie; None for one that is left out."""
    offsets = table - _number(text, "<i", table)
    size = _number(text, "<H", offsets)

    def field(n: int) -> int | None:
        known = _number(text, "<H", offsets + 4 + 2 * n) if 4 + 2 * n < size else 0
        return table + known if known else None

    return field


def _at(text: memoryview, place: int) -> int:
    """Where the offset at a place leads."""
    return place + _number(text, "<I", place)


def _number(text: memoryview, form: str, at: int) -> int:
    if at < 0:
        raise struct.error
    return int(struct.unpack_from(form, text, at)[0])
