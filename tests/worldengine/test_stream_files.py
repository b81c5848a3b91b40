"""A file of which nothing is known is bounded before it is unpacked, and whatever is wrong with it is one kind of error."""

import random
from pathlib import Path
from typing import Any

import numpy as np
import pyarrow as pa
import pytest

from small_worlds import ball, empty, record
from worldengine.recording import record as recording_of
from worldengine.recording import stored, stream_files
from worldengine.recording.columns import TABLES, arrow_schema
from worldkit.errors import RecordingError

SCHEMA = arrow_schema(TABLES["edits"])


def written(path: Path, rows: int, batches: int = 1, schema: pa.Schema = SCHEMA, **columns: Any) -> Path:
    """A packed table of edits that repeat each other."""
    whole = {
        "time": np.zeros(rows), "row": np.zeros(rows, np.int32), "step": np.zeros(rows, np.int32),
        "array": ["body_mass"] * rows, "index": np.zeros(rows, np.int32), "value": np.zeros(rows),
    }  # fmt: skip
    arrays = [columns.get(field.name) or pa.array(whole[field.name], field.type) for field in schema]
    options = pa.ipc.IpcWriteOptions(compression="zstd")
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema, options=options) as writer:
        for _ in range(batches):
            writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))
    return path


def test_what_would_unpack_to_more_than_is_recorded_is_refused_before_it_does(tmp_path: Path) -> None:
    """Twelve batches of 100,000 rows in some kilobytes; Arrow's own count says that none of them was unpacked."""
    path = written(tmp_path / "edits.arrows", 100_000, 12, array=pa.array([""] * 100_000))
    assert path.stat().st_size < 50_000
    begun = pa.default_memory_pool().max_memory()
    for torn in (True, False):
        with pytest.raises(RecordingError, match="unpacks to more than 30 MiB, the most") as caught:
            stream_files.batches(path, torn=torn, most=30 << 20)
        assert "control_every" in caught.value.next_move
        with pytest.raises(RecordingError, match="more than the 1199999 rows that the run has room for"):
            stream_files.batches(path, torn=torn, rows=1_199_999)
    assert pa.default_memory_pool().max_memory() == begun


def test_a_buffer_that_says_it_is_larger_is_no_memory(tmp_path: Path) -> None:
    path = written(tmp_path / "edits.arrows", 50)
    content = path.read_bytes()
    size = (400).to_bytes(8, "little")  # of `time`, in front of its packed bytes
    assert content.count(size) == 2, "time and value"
    for said in (1 << 40, (1 << 62) - 1):
        path.write_bytes(content.replace(size, said.to_bytes(8, "little")))
        with pytest.raises(RecordingError, match="unpacks to more than 2048 MiB"):
            stream_files.batches(path)
    path.write_bytes(content.replace(size, (408).to_bytes(8, "little")))
    with pytest.raises(RecordingError, match="is damaged"):
        stream_files.batches(path)


def test_words_of_another_kind_are_none_of_a_tables(tmp_path: Path) -> None:
    """A dictionary would be unpacked beside the batches."""
    words = pa.array(["body_mass"] * 9).dictionary_encode()
    schema = SCHEMA.set(3, pa.field("array", words.type))
    path = written(tmp_path / "edits.arrows", 9, schema=schema, array=words)
    with pytest.raises(RecordingError, match="a message is none of a table's"):
        stream_files.batches(path)


def test_whatever_is_changed_in_a_file_it_is_read_or_refused_and_nothing_else(tmp_path: Path) -> None:
    content = written(tmp_path / "edits.arrows", 60, 2).read_bytes()
    chance, refused = random.Random(1), 0
    for n in range(400):
        path = tmp_path / f"{n}.arrows"
        changed = bytearray(content[: chance.choice((len(content), chance.randrange(len(content))))])
        for _ in range(chance.choice((1, 4, 16))):
            changed[chance.randrange(len(changed))] = chance.choice((0, 255, chance.randrange(256)))
        path.write_bytes(changed)
        for torn in (True, False):
            try:
                stream_files.batches(path, torn=torn)
            except RecordingError:
                refused += 1
        path.unlink()
    assert refused > 300


def test_the_recorder_stops_where_nobody_would_read_on(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def control(model: Any, data: Any) -> None:
        data.xfrc_applied[1, 0] = data.time

    spec = empty()
    ball(spec, "ball", (0, 0, 1))
    monkeypatch.setattr(recording_of, "MOST_BYTES", 64)
    with pytest.raises(RecordingError, match="would have more than 0 MiB of rows"):
        record(spec, tmp_path / "r", 40, control)


def test_a_table_that_nobody_asks_for_is_not_opened(tmp_path: Path) -> None:
    written(tmp_path / "edits.arrows", 3)
    found = stored.Replayable(tmp_path)
    (tmp_path / "edits.arrows").unlink()
    assert not len(found.edits)
