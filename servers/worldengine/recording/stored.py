"""Read a recording as numpy arrays; a torn one up to its last flushed batch.

>>> recording = open("out/trajectory")  # doctest: +SKIP
>>> recording.pos[-1, recording.body("cue_ball")]  # doctest: +SKIP

The folder holds `meta.json`, `state.arrows` and the tables `contacts`, `interventions`, `warnings`, `edits`, `inputs`
(Arrow IPC streams; `columns` says what is in them), with an author's law also `media` and `balances`, and `complete.json` once the run ended well. The streams are mapped into
memory; of those that are packed (`record.PACKED`) the rows are unpacked when the table is opened. Rows of `interventions` that
push lie in `pushes.arrows` (`push_blocks`), and wide answers in `inputs` as errors of a forecast (`foretold`).
"""

import hashlib
import json
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.errors import RecordingError

from . import long_table, push_blocks, stream_files
from .columns import CAMERAS_FILE, LATER, OF_MEDIA, OVERLAPS_FILE, SCHEMA_VERSION, TABLES, Column, from_meta
from .foretold import BYTES, WEIGHTS, Forecast, weights_of
from .record import HASHED, combine

if TYPE_CHECKING:
    import numpy as np
    import pyarrow as pa

RECORD = "record with `python simulation.py --pass physics --out DIR`"
__all__ = ["Recording", "RecordingError", "Replayable", "Table", "digest", "inputs_digest", "open"]


class Table:
    """One stream file with its columns as attributes: (rows, …) arrays, made when first asked for.

    A column that lies in one batch is a view of it, in the mapped file where that is not packed; one of several batches is
    joined, once.
    """

    def __init__(self, path: Path, columns: tuple[Column, ...], limit: int | None = None) -> None:
        self._path, self._limit = path, limit
        self.columns = {column.name: column for column in columns}
        self._made: dict[str, np.ndarray] = {}

    @cached_property
    def _read(self) -> stream_files.Batches:
        """What the file holds: it is opened when the first row of it is asked for."""
        return stream_files.batches(self._path, torn=True)

    @cached_property
    def _batches(self) -> "list[pa.RecordBatch]":
        return [batch for batch, _ in self._read]

    @cached_property
    def _length(self) -> int:
        whole = sum(batch.num_rows for batch in self._batches)
        return whole if self._limit is None else min(whole, self._limit)

    def __len__(self) -> int:
        return self._length

    def __getattr__(self, name: str) -> "np.ndarray":
        if name.startswith("_"):
            raise AttributeError(name)
        return self[name]

    def __getitem__(self, name: str) -> "np.ndarray":
        """A column by name; unknown names list the known ones."""
        if name not in self._made:
            later = LATER.get((self._path.stem, name))
            if later is not None and not self.holds(name):
                import numpy as np

                return np.full(self._length, later, np.int32)
            if name not in self.columns:
                raise AttributeError(f"{self._path.name} has no column {name!r}; it has: {', '.join(self.columns)}")
            self._made[name] = self._column(self.columns[name])
        return self._made[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.columns]

    def holds(self, name: str) -> bool:
        """Whether its file has this column."""
        return name in (self._batches[0].schema.names if self._batches else self.columns)

    def take(self, columns: "Mapping[str, np.ndarray]") -> None:
        """Have these columns, if any, in place of the file's."""
        self._made.update(columns)
        self._length = next((len(column) for column in columns.values()), self._length)

    def _column(self, column: Column) -> "np.ndarray":
        import numpy as np

        if column.dtype == "string":
            return np.array([v for held in self._held(column) for v in held.to_pylist()], dtype=str)[: self._length]
        parts = self._parts(column) if column.width else []
        if len(parts) == 1:
            return parts[0][: self._length]
        if not parts:
            return np.empty((self._length if not column.width else 0, *column.shape), column.dtype)
        joined = np.concatenate(parts)[: self._length]
        joined.flags.writeable = False
        return joined

    def _parts(self, column: Column) -> "list[np.ndarray]":
        """The numbers of a column, batch by batch."""
        return [_numbers(held, column) for held in self._held(column)]

    def _held(self, column: Column) -> list[Any]:
        """What the file holds of a column, batch by batch."""
        if any(column.name not in batch.schema.names for batch in self._batches):
            cause = f"it has no column {column.name}, which an earlier version did not record"
            raise RecordingError(cause, str(self._path), "run the physics pass again")
        return [batch[column.name] for batch in self._batches]


class Inputs(Table):
    """The table `inputs`, however its file holds the values (`foretold`)."""

    def _parts(self, column: Column) -> "list[np.ndarray]":
        if not self._batches or column.name in self._batches[0].schema.names:
            return super()._parts(column)
        forecast, found = Forecast(), []
        for batch, about in self._read:
            try:
                step, entry, *errors = (batch[name].to_numpy() for name in ("step", "entry", *BYTES))
                found.append(forecast.decode(step, entry, errors, weights_of(about.get(WEIGHTS, b""))))
            except ValueError as cause:
                raise stream_files.damaged(self._path, cause) from cause
        return found


class Recording:
    """A recording folder. `meta`, `complete`, `names`, and every state column as an attribute.

    T rows, B bodies (all but the world, in the model's order), in the world frame; see `columns.state_columns` for
    shapes and units. `contacts`, `interventions`, `warnings` and `edits` are tables.
    """

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder)
        self.meta: dict[str, Any] = _json(
            self.folder / "meta.json", "this is not a recording, or it ended before it began"
        )
        if self.meta.get("schema") != SCHEMA_VERSION:
            raise RecordingError(
                f"the recording has schema {self.meta.get('schema')!r}, this version reads {SCHEMA_VERSION}",
                str(self.folder),
                "run the physics pass again",
            )
        end = self.folder / "complete.json"
        self.ending: dict[str, Any] = _json(end, "the ending is damaged") if end.exists() else {}
        self.complete = bool(self.ending)
        """It is False when the run crashed, was killed, or blew up; the rows then end with the last flushed batch."""
        self.names: tuple[str, ...] = tuple(body["name"] for body in self.meta["bodies"])
        self._state = self._table("state")
        if self.complete and len(self._state) != self.ending["rows"]:
            raise RecordingError(
                f"the recording ended with {self.ending['rows']} rows, but {len(self._state)} can be read",
                str(self.folder / "state.arrows"),
                "the file was damaged after it was written: run the physics pass again",
            )

    def _table(self, name: str) -> Table:
        columns = from_meta(self.meta["columns"].get(name, ()))
        if name == "state":  # columns without numbers are not in the file, and yet have a shape
            from .columns import state_columns

            known = {column.name for column in columns}
            sizes = {"bodies": len(self.names), **self.meta["sizes"]}
            columns += tuple(c for c in state_columns(sizes, empty=True) if c.name not in known)
        return Table(self.folder / f"{name}.arrows", columns)

    def __len__(self) -> int:
        return len(self._state)

    def __getattr__(self, name: str) -> "np.ndarray":
        if name.startswith("_"):
            raise AttributeError(name)
        return self._state[name]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._state.columns]

    @cached_property
    def contacts(self) -> Table:
        """Contacts, in the order of their rows; those of rows that were lost are left out."""
        import numpy as np

        table = self._table("contacts")
        whole = int(np.searchsorted(table.row, len(self))) if len(table) else 0
        return table if whole == len(table) else Table(table._path, tuple(table.columns.values()), whole)

    @cached_property
    def interventions(self) -> Table:
        """The interventions: what acted on the state besides the engine's own step; pushes are kept in blocks (`push_blocks`)."""
        table = self._table("interventions")
        blocks = stream_files.batches(self.folder / push_blocks.FILE, torn=True)
        table.take(push_blocks.join(table, (block for block, _ in blocks)))
        return table

    @cached_property
    def warnings(self) -> Table:
        """The engine's warnings."""
        return self._table("warnings")

    @cached_property
    def edits(self) -> Table:
        """Changes of model arrays, for the replay."""
        return self._table("edits")

    @cached_property
    def inputs(self) -> Table:
        """What was sent to the world: of each answer, the difference from the one before."""
        table = self._table("inputs")
        return Inputs(table._path, tuple(table.columns.values()))

    @cached_property
    def media(self) -> Table:
        """The points of the author's laws, now and then."""
        return self._table("media")

    @cached_property
    def balances(self) -> Table:
        """The sums of the author's laws, as often."""
        return self._table("balances")

    def channels(self, solver: str) -> "dict[str, np.ndarray]":
        """(T, …) columns of a solver by their own names; `solver` is its name in `meta` (`solvers.called`)."""
        own = (name for name in self._state.columns if name.startswith(f"{solver}."))
        return {name.removeprefix(f"{solver}."): self._state[name] for name in own}

    @cached_property
    def overlaps(self) -> list[dict[str, Any]] | None:
        """Visible geoms that overlap because they cannot collide (see `drawn_overlaps`); None when nobody looked."""
        path = self.folder / OVERLAPS_FILE
        return list(_json(path, "the list of overlaps is damaged")["pairs"]) if path.exists() else None

    @cached_property
    def cameras(self) -> dict[str, Any] | None:
        """Where each camera stands, and the pictures' size (see `standing_cameras`); None when nobody looked."""
        path = self.folder / CAMERAS_FILE
        return _json(path, "the list of cameras is damaged") if path.exists() else None

    @cached_property
    def com(self) -> "np.ndarray":
        """(T, B, 3) m: centres of mass of the single bodies, from the poses and the offsets (`ipos`) in `meta`."""
        return self.pos + self._com_offset

    @cached_property
    def comvel(self) -> "np.ndarray":
        """(T, B, 3) m/s: velocity of the centres of mass."""
        from worldkit.turning import cross

        return self.linvel + cross(self.angvel, self._com_offset)

    @cached_property
    def _com_offset(self) -> "np.ndarray":
        """(T, B, 3) m: from body origins to centres of mass, world frame."""
        import numpy as np

        from worldkit.turning import turned

        return turned(self.quat, np.array([body["ipos"] for body in self.meta["bodies"]]).reshape(-1, 3))

    @property
    def sha256(self) -> str:
        """The hash of the trajectory, as recorded; it is computed from the rows when the run did not end well."""
        return str(self.ending.get("sha256") or digest(self))

    @cached_property
    def shown_sha256(self) -> str:
        """The hash of all that pictures can show of it: the trajectory, and what changes beside it: colours, sizes and lights
        (`edits`), the channels of solvers (a water's surface), and the points of the author's laws.
        """
        said = {name: rows for name in ("laws", "solvers", "shown") if (rows := self.meta.get(name))}
        told = {name: self._state[name] for name in self._state.columns if "." in name}
        told |= {f"edits {n}": self.edits[n] for n in self.edits.columns if n != "time" and len(self.edits)}
        media, points = self._table("media").columns, long_table.rows(self.folder / "media.arrows")
        if not said and not told and not points:
            return self.sha256
        shown = hashlib.sha256(f"{self.sha256}\n{json.dumps(said, sort_keys=True)}".encode())
        for name, values in told.items():
            shown.update(f"\n{name} {len(values)} ".encode() + _content(values))
        for name in media if points else ():
            long_table.hashed(shown, self.folder / "media.arrows", f"media {name}", points)
        return shown.hexdigest()

    @property
    def time_step(self) -> float:
        """The time step of the simulation, s."""
        return float(self.meta["time_step"])

    def body(self, name: str) -> int:
        """Index of a body along the B axis; unknown names list the known ones."""
        return self._index(name, self.names, "body")

    def geom(self, name: str) -> int:
        """Index of a geom, as in `contacts.geom1`."""
        return self._index(name, tuple(geom["name"] for geom in self.meta["geoms"]), "geom")

    def _index(self, name: str, known: tuple[str, ...], kind: str) -> int:
        if name not in known:
            raise RecordingError(
                f"there is no {kind} {name!r} in this recording", str(self.folder), f"name one of: {', '.join(known)}"
            )
        return known.index(name)


class Replayable:
    """The part of a recording that drives its world again: the tables `inputs` and `edits`, and what a law told beside them
    (`media`, `balances`); the rest may be missing.
    """

    def __init__(self, folder: Path | str) -> None:
        self.folder = Path(folder)
        self.inputs = Inputs(self.folder / "inputs.arrows", TABLES["inputs"])
        self.edits, self.media, self.balances = (
            Table(self.folder / f"{name}.arrows", TABLES[name]) for name in ("edits", *OF_MEDIA)
        )


def inputs_digest(folder: Path) -> str:
    """SHA-256 of what was sent to a world, the rows of `inputs`, `edits` and of its laws; empty when nothing was sent."""
    found, digest = Replayable(folder), hashlib.sha256()
    path, laws = found.folder / "media.arrows", int(found.balances.medium.max(initial=-1)) + 1
    points = long_table.rows(path, laws)
    kept = (schema.names if (schema := stream_files.schema(path)) else []) if points else []
    balances = [("balances", found.balances)] if len(found.balances) else []
    for name, table in [("inputs", found.inputs), ("edits", found.edits), ("media", None), *balances]:
        for column in (c for c in TABLES[name] if c.name not in ("time", "row")):
            if table is None:
                if points and ((name, column.name) not in LATER or column.name in kept):
                    long_table.hashed(digest, path, f"media.{column.name}", points, laws)
            elif (name, column.name) not in LATER or table.holds(column.name):
                values = table[column.name]
                digest.update(f"\n{name}.{column.name} {len(values)} ".encode() + _content(values))
    return digest.hexdigest() if points or balances or len(found.inputs) or len(found.edits) else ""


def by_laws(media: Table, laws: int) -> "np.ndarray":
    """(rows,) bool: which points are of the first so many media, the author's laws; those behind are what solvers of the suite move,
    which nobody sends.
    """
    import numpy as np

    return np.asarray(media.medium) < laws


def open(folder: Path | str) -> Recording:
    """Open a recording folder; raises `RecordingError` when it is missing, foreign or damaged."""
    return Recording(folder)


def digest(recording: Recording) -> str:
    """The trajectory's SHA-256, recomputed from the rows.

    Of each column `time, qpos, qvel, pos, quat`, the bytes (float64, little-endian, row after row) are hashed, and the
    result is the hash of the lines `<name> <hash>`. Batch boundaries do not matter.
    """
    import numpy as np

    def column(name: str) -> str:
        return hashlib.sha256(np.ascontiguousarray(getattr(recording, name)).data).hexdigest()

    return combine({name: column(name) for name in HASHED})


def _content(values: "np.ndarray") -> bytes:
    """The bytes of a column; those of texts lie apart by a zero."""
    return "\0".join(values.tolist()).encode() if values.dtype.kind == "U" else values.tobytes()


def _numbers(array: "pa.Array", column: Column) -> "np.ndarray":
    """One batch of one column as a view."""
    if not column.shape:
        flat = array
    elif array.null_count:
        flat = array.flatten()
    else:  # the same without importing pyarrow.compute
        width = array.type.list_size
        flat = array.values.slice(array.offset * width, len(array) * width)
    return flat.to_numpy(zero_copy_only=True).reshape(-1, *column.shape)


def _json(path: Path, meaning: str) -> dict[str, Any]:
    try:
        value = json.loads(path.read_bytes())
    except (OSError, ValueError) as failure:
        raise RecordingError(f"{meaning} ({failure})", str(path), RECORD) from failure
    if not isinstance(value, dict):
        raise RecordingError(meaning, str(path), RECORD)
    return value
