"""The points of a law are read batch after batch: their hash and their replay hold no more of a long run than of a short one."""

import hashlib
import tracemalloc
from pathlib import Path

import numpy as np
import pyarrow as pa
import pytest

from worldengine.recording import stored
from worldengine.recording.columns import TABLES, arrow_schema
from worldengine.recording.long_table import OneMedium

COUNTS = (500, 300)
"""Points of each medium; an instant of both is 22,400 bytes unpacked."""


def write(folder: Path, instants: int, each: int) -> dict[str, np.ndarray]:
    """A file of `media`, some rows a batch; returns its columns. Only the first medium is a law's."""
    count = sum(COUNTS)
    columns = {
        "step": np.repeat(np.arange(instants, dtype=np.int32) * 4, count),
        "medium": np.tile(np.repeat(np.arange(2, dtype=np.int32), COUNTS), instants),
        "point": np.tile(np.concatenate([np.arange(n, dtype=np.int32) for n in COUNTS]), instants),
        "place": np.arange(instants * count * 3, dtype=np.float32).reshape(-1, 3),
        "colour": np.tile(np.repeat(np.array([255, -1], np.int32), COUNTS), instants),
    }
    schema = arrow_schema(TABLES["media"])
    packed = pa.ipc.IpcWriteOptions(compression="zstd")
    with pa.OSFile(str(folder / "media.arrows"), "wb") as sink, pa.ipc.new_stream(sink, schema, options=packed) as out:
        for first in range(0, instants * count, each):
            some = {name: values[first : first + each] for name, values in columns.items()}
            arrays = [
                pa.FixedSizeListArray.from_arrays(pa.array(some[f.name].ravel()), type=f.type)
                if f.name == "place"
                else pa.array(some[f.name], f.type)
                for f in schema
            ]
            out.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))
    schema = arrow_schema(TABLES["balances"])
    row = {f.name: [[0.0] * f.type.list_size] if pa.types.is_fixed_size_list(f.type) else [0] for f in schema}
    with pa.OSFile(str(folder / "balances.arrows"), "wb") as sink, pa.ipc.new_stream(sink, schema) as out:
        out.write_batch(pa.RecordBatch.from_arrays([pa.array(row[f.name], f.type) for f in schema], schema=schema))
    return columns


def test_the_hash_of_a_long_run_holds_a_batch_of_it(tmp_path: Path) -> None:
    columns = write(tmp_path, 1200, 16_000)
    begun = pa.total_allocated_bytes()
    tracemalloc.start()
    found = stored.inputs_digest(tmp_path)
    _, most = tracemalloc.get_traced_memory()
    tracemalloc.stop()
    assert most + pa.total_allocated_bytes() - begun < 8e6  # of 27 MB; before, all of it and more
    digest, law = hashlib.sha256(), columns["medium"] == 0
    for table in ("inputs", "edits"):  # nothing was sent
        for name in (c.name for c in TABLES[table] if c.name not in ("time", "row")):
            digest.update(f"\n{table}.{name} 0 ".encode())
    for name in (c.name for c in TABLES["media"]):
        digest.update(f"\nmedia.{name} {law.sum()} ".encode() + columns[name][law].tobytes())
    sums = stored.Replayable(tmp_path).balances
    for column in (c.name for c in TABLES["balances"]):
        digest.update(f"\nbalances.{column} 1 ".encode() + sums[column].tobytes())
    assert found == digest.hexdigest()


@pytest.mark.parametrize("each", [700, 800, 5000])
def test_an_instant_is_found_wherever_its_batches_begin(tmp_path: Path, each: int) -> None:
    columns = write(tmp_path, 20, each)
    for number, count in enumerate(COUNTS):
        mine = columns["medium"] == number
        lay = OneMedium(tmp_path / "media.arrows", number, count)
        assert (len(lay), lay.rows, lay.coloured) == (20, 20 * count, number == 0)
        assert lay.steps.tolist() == list(range(0, 80, 4))
        for instant in (0, 19, 7, 8):
            rows = slice(instant * count, (instant + 1) * count)
            assert np.array_equal(lay.places(instant), columns["place"][mine][rows])
            assert np.array_equal(lay.colours(instant), columns["colour"][mine][rows])


def test_a_torn_file_has_its_whole_instants(tmp_path: Path) -> None:
    write(tmp_path, 20, 800)
    path = tmp_path / "media.arrows"
    path.write_bytes(path.read_bytes()[:-3000])
    lay = OneMedium(path, 0, COUNTS[0])
    assert 10 < len(lay) < 20 and lay.places(len(lay) - 1).shape == (COUNTS[0], 3)
    assert not len(OneMedium(tmp_path / "none.arrows", 0, 5))
