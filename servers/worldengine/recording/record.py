"""Record a simulation into a folder without slowing it down.

Why Arrow IPC *streams*: a stream is a sequence of self-contained record batches, so whatever was flushed before a
crash can be read, with no footer to lose; uncompressed batches are memory-mapped and become numpy arrays without a
copy; the schema travels with the data, with no pickle and nothing to execute; it is written as it happens, in constant
memory; and every language reads it.

How it stays fast: a row is a dozen plain copies into preallocated buffers. Everything else (velocities of points,
contact forces, momentum, hashing, writing) is done for a whole batch at once, by numpy, on a second thread that runs
while the engine (which lets go of the interpreter) computes the next batch.

Row n holds the state at time n and the quantities derived from that same state; see `simulate`.
"""

import hashlib
import queue
import shutil
import threading
import time
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import RecordingError
from worldkit.files import write_json
from worldkit.speaking import ARRAYS

from .batch import Batch
from .bonds import bonds_of
from .coded_words import Words
from .columns import FORETOLD_COLUMNS, OF_MEDIA, SCHEMA_VERSION, TABLES, Column, arrow_schema, as_meta, state_columns
from .derived_columns import Derived
from .foretold import BYTES, FEWEST, WEIGHTS, Forecast
from .push_blocks import PushStream
from .stream_files import LESS, MOST_BYTES, REMEDIES

if TYPE_CHECKING:
    import mujoco
    import numpy as np

BATCH_BYTES = 3 << 20
"""The raw size of a batch, bytes, which sets its number of rows."""
FLUSH_S = 0.5
"""A batch is flushed at the latest so long after its first row, s of wall-clock time."""
PACKED = ("interventions", "inputs", "edits", "media", "balances")
"""Tables whose rows repeat each other; the state, contacts and warnings are read from the disk as they lie there."""
HASHED = ("time", "qpos", "qvel", "pos", "quat")
"""Columns that identify a trajectory."""


class Recorder:
    """Writes one recording; a context manager. Leaving it by an exception keeps what was recorded, marked incomplete.

    Args:
        model, data: the world; `data` must be the one that is simulated.
        folder: it is created, and must not hold a recording yet.
        meta: the content of `meta.json` besides the columns (see `describe`).
        batch_rows: rows in a batch; None chooses by size. The hash of the trajectory does not depend on it.
        channels: more columns of the state, each with the array that holds it when `after()` is called.

    Call `before()` when positions and velocities are computed, `after()` when forces are, once for each row.
    """

    def __init__(
        self,
        model: "mujoco.MjModel",
        data: "mujoco.MjData",
        folder: Path,
        meta: dict[str, Any],
        batch_rows: int | None = None,
        channels: "Mapping[Column, np.ndarray] | None" = None,
    ) -> None:
        self._data, self._folder = data, Path(folder)
        if (self._folder / "meta.json").exists():
            raise RecordingError("there is a recording in this folder already", str(folder), "record into a new folder")
        sizes = {"bodies": model.nbody - 1, **{k: int(getattr(model, k)) for k in _SIZES}}
        sizes["stressed"] = model.neq if bonds_of(model) else 0
        self._channels = dict(channels or {})
        self.columns = (*state_columns(sizes), *self._channels)
        self._derived = Derived(model, tuple(column.name for column in self._channels))
        row_bytes = 8 * (model.nq + model.nv + 22 * model.nbody + 200)
        self.batch_rows = batch_rows or max(8, min(1024, BATCH_BYTES // row_bytes))
        live = {column.name: array for column, array in self._channels.items()}
        batches = [Batch(model, data, self.batch_rows, live) for _ in range(3)]
        self._batch = batches.pop()
        self._free: queue.SimpleQueue[Batch] = queue.SimpleQueue()
        for batch in batches:
            self._free.put(batch)
        self._full: queue.SimpleQueue[Batch | None] = queue.SimpleQueue()
        self._failure: BaseException | None = None
        self._started = 0.0
        self.before_flush: list[Callable[[], object]] = []
        """These are called before a batch is handed over, the last moment to add what belongs to it."""
        self.rows = 0
        self.max_depth_m = 0.0
        self._counts: dict[str, int] = {}
        self.warnings: dict[str, int] = {}
        self._hashes = {name: hashlib.sha256() for name in HASHED}
        moves = meta.get("laws") or meta.get("shown")
        told = {name: columns for name, columns in TABLES.items() if moves or name not in OF_MEDIA}
        tables = {name: as_meta(columns) for name, columns in told.items()}
        self._folder.mkdir(parents=True, exist_ok=True)
        write_json(
            self._folder / "meta.json",
            {"schema": SCHEMA_VERSION, **meta, "columns": {"state": as_meta(self.columns), **tables}},
        )
        wide = sum(len(entries) for array, entries in meta.get("inputs", {}).items() if array in ARRAYS) >= FEWEST
        self._streams = {
            name: (_Foretold if wide and name == "inputs" else _Stream)(self._folder / f"{name}.arrows", columns)
            for name, columns in {"state": self.columns, **told}.items()
        }
        self._pushes = PushStream(self._folder)
        self._thread = threading.Thread(target=self._work, name="recorder", daemon=True)
        self._thread.start()

    def __enter__(self) -> "Recorder":
        return self

    def __exit__(self, kind: object, error: object, trace: object) -> None:
        self.close(complete=kind is None)

    @property
    def counts(self) -> dict[str, int]:
        """Rows of the ledger by kind, valid once the recorder is closed."""
        pushed = self._pushes.counts
        return {kind: self._counts.get(kind, 0) + pushed.get(kind, 0) for kind in {**self._counts, **pushed}}

    @property
    def recorded(self) -> int:
        """The number of rows so far, which is the index of the next one."""
        return self._batch.first_row + self._batch.rows

    def before(self) -> None:
        """Copy the state and what derives from positions and velocities (after `mj_step1`, before the step)."""
        self._batch.copy_before(self._data)

    def after(self) -> None:
        """Copy what derives from forces (after `mj_step2`, or after `mj_forward`), and end the row."""
        batch = self._batch
        batch.copy_after(self._data)
        now = time.perf_counter()
        if batch.rows == 1:
            self._started = now
        if batch.rows == batch.capacity or now - self._started > FLUSH_S:
            self.flush()

    def inputs_again(self) -> None:
        """Copy the controls again into the row under way, as they were written after it began."""
        batch = self._batch
        if batch.controls is not None:
            buffer, source = batch.controls
            buffer[batch.rows] = source

    def later(self, table: str, made: Callable[[], Any]) -> None:
        """Add what the writer's thread computes: columns of rows of a table, or to `pushes` its blocks."""
        self._batch.later[table].append(made)

    def event(self, table: str, *values: Any) -> None:
        """Add a row to `interventions`, `warnings` or `edits`, in the order of their columns."""
        self._batch.events[table].append(values)
        if table == "warnings":
            self.warnings[values[1]] = self.warnings.get(values[1], 0) + values[2]

    def as_given(self, table: str, folder: Path) -> None:
        """Let a table be the file of another recording, byte by byte, if that has one; nothing may be added to it."""
        given = folder / f"{table}.arrows"
        if given.exists():
            self._streams[table].close()
            shutil.copyfile(given, self._folder / given.name)

    def flush(self) -> None:
        """Hand the current batch to the writer; waits only when the disk is two batches behind."""
        self._raise_failure()
        self._hand_over()

    def _hand_over(self) -> None:
        for add in self.before_flush:
            add()
        self.rows = self._batch.first_row + self._batch.rows
        self._full.put(self._batch)
        self._batch = self._free.get()
        self._batch.clear(self.rows)

    def close(self, complete: bool) -> str:
        """Flush, and with `complete` write `complete.json`; returns the trajectory's SHA-256."""
        if self._thread.is_alive():
            self._hand_over()
            self._full.put(None)
            self._thread.join()
        self._pushes.close()
        for stream in self._streams.values():
            stream.close()
        if complete:
            self._raise_failure()
            write_json(self._folder / "complete.json", {"rows": self.rows, "sha256": self.sha256()})
        return self.sha256()

    def sha256(self) -> str:
        """The hash of the hashed columns' bytes, valid once the recorder is closed; see `stored.digest`."""
        return combine({name: digest.hexdigest() for name, digest in self._hashes.items()})

    def _raise_failure(self) -> None:
        if self._failure is not None:
            raise RecordingError(
                f"the recording cannot be written: {self._failure}",
                str(self._folder),
                "free some disk space, or raise the file size limit",
            ) from self._failure

    def _work(self) -> None:
        """Work as the writer's thread: derive, hash, write, hand the buffers back."""
        while (batch := self._full.get()) is not None:
            if self._failure is None:
                try:
                    self._write(batch)
                except BaseException as failure:  # the simulating thread learns of it at its next flush
                    self._failure = failure
            self._free.put(batch)

    def _write(self, batch: Batch) -> None:
        for make in batch.later["pushes"]:
            self._pushes.write(make())
        for table, events in batch.events.items():
            names = [column.name for column in TABLES[table]]
            parts = [made for make in batch.later[table] if len((made := make())[names[0]])]
            if events:
                parts.append(dict(zip(names, zip(*events, strict=True), strict=True)))
            if parts:
                self._add(table, parts)
        if batch.rows:  # last, so that a kill leaves no state whose inputs are missing
            if batch.contact_count:
                contacts = self._derived.contacts(batch)
                self.max_depth_m = max(self.max_depth_m, float(contacts["depth_m"].max()))
                self._streams["contacts"].write(contacts)
            columns = self._derived.state(batch)
            for name in HASHED:
                self._hashes[name].update(columns[name].data)
            self._streams["state"].write(columns)

    def _add(self, table: str, parts: list[dict[str, Any]]) -> None:
        """Write rows of a table in the order of their times (or steps), in whatever order they were noted."""
        import numpy as np

        columns: dict[str, Any] = {}
        for column in TABLES[table]:
            found = [part[column.name] for part in parts]
            if column.dtype == "string":
                columns[column.name] = Words.joined([f if isinstance(f, Words) else Words.of(f) for f in found])
            else:
                arrays = [np.asarray(f, column.dtype).reshape(-1, *column.shape) for f in found]
                columns[column.name] = arrays[0] if len(arrays) == 1 else np.concatenate(arrays)
        if len(parts) > 1:
            order = np.argsort(columns[TABLES[table][0].name], kind="stable")
            columns = {n: c.taken(order) if isinstance(c, Words) else c[order] for n, c in columns.items()}
        if table == "interventions":
            for kind, count in columns["kind"].counts().items():
                self._counts[kind] = self._counts.get(kind, 0) + count
        self._streams[table].write(columns)


class _Stream:
    """One Arrow IPC stream file: each batch reaches the operating system in one go."""

    def __init__(self, path: Path, columns: tuple[Column, ...]) -> None:
        import pyarrow as pa

        self._columns = columns
        self._schema = arrow_schema(columns)
        self._path, self._room = path, MOST_BYTES if path.stem in PACKED else None
        self._sink = pa.OSFile(str(path), "wb")
        options = pa.ipc.IpcWriteOptions(compression="zstd" if path.stem in PACKED else None)
        self._writer = pa.ipc.new_stream(self._sink, self._schema, options=options)

    def write(self, values: dict[str, Any], about: "dict[bytes, str] | None" = None) -> None:
        """Append one record batch, with what is said about it."""
        import numpy as np
        import pyarrow as pa

        arrays = []
        for column, field in zip(self._columns, self._schema, strict=True):
            value = values[column.name]
            if column.dtype == "string":
                arrays.append(value.arrow() if isinstance(value, Words) else pa.array(value, pa.string()))
                continue
            numbers = np.ascontiguousarray(value, column.dtype).reshape(-1)
            kind = field.type.value_type if column.shape else field.type
            flat = pa.Array.from_buffers(kind, len(numbers), [None, pa.py_buffer(numbers)])  # `pa.array` loads numpy.ma
            arrays.append(pa.FixedSizeListArray.from_arrays(flat, type=field.type) if column.shape else flat)
        batch = pa.RecordBatch.from_arrays(arrays, schema=self._schema)
        if self._room is not None:
            self._room -= batch.nbytes
            if self._room < 0:  # what nobody would read again is not written
                what = f"{self._path.name} would have more than {MOST_BYTES / 2**20:.0f} MiB of rows"
                raise RecordingError(what, str(self._path), REMEDIES.get(self._path.stem, LESS))
        self._writer.write_batch(batch, about)

    def close(self) -> None:
        """End the stream."""
        if not self._sink.closed:
            self._writer.close()
            self._sink.close()


class _Foretold(_Stream):
    """The stream of `inputs` where answers are wide."""

    def __init__(self, path: Path, columns: tuple[Column, ...]) -> None:  # noqa: ARG002 (they are its own)
        super().__init__(path, FORETOLD_COLUMNS)
        self._forecast = Forecast()

    def write(self, values: dict[str, Any], about: "dict[bytes, str] | None" = None) -> None:
        """Append one record batch with the errors of the values in their place."""
        weights, errors = self._forecast.encode(*(values[name] for name in ("step", "entry", "value")))
        about = {**(about or {}), WEIGHTS: " ".join(map(repr, weights))}
        super().write({**values, **dict(zip(BYTES, errors, strict=True))}, about)


def combine(digests: dict[str, str]) -> str:
    """The trajectory's hash from those of its columns: SHA-256 over `name digest` lines in the order of `HASHED`."""
    return hashlib.sha256("".join(f"{name} {digests[name]}\n" for name in HASHED).encode()).hexdigest()


_SIZES = ("nq", "nv", "na", "nu", "nmocap", "neq", "ntendon", "nsensordata", "nplastic")
