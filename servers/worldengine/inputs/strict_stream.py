"""Read a stored input stream as strictly as it was written: whoever forges one gets a typed error, never another world.

The engine takes what it is given: an entry of -5 counts from the end, a row that is never due is never looked at, an edit
acts whether a plan declares it or not. So everything is checked before the first step: the columns, steps in their order and
within the run, each entry once a step, finite values, and edits of declared parameters only. What passes is just another
true run, and its ledger says what pushed.
"""

from pathlib import Path
from typing import TYPE_CHECKING

from worldkit.errors import RecordingError
from worldkit.laws import HUGE
from worldkit.model_arrays import LOOKS, Edit
from worldkit.speaking import HELD

from ..recording import point_colours, stream_files
from ..recording.columns import FORETOLD_COLUMNS, LATER, OF_MEDIA, TABLES, arrow_schema
from ..recording.stored import by_laws
from ..recording.stream_files import REMEDY
from .ports import Ports, flat

if TYPE_CHECKING:
    import mujoco
    import numpy as np

    from ..recording.stored import Recording, Replayable, Table
    from .declared_media import Media

SUMS = ("mass", "momentum", "energy", "weight", "stored", "volume", "held")
"""The columns of `balances` in the order in which a law tells them."""
ANOTHER = "it is of another medium than is due"
ENOUGH = 4096
"""So many rows are read whatever there is room for, since the first of them that is wrong is then named with its cause."""


class Recorded:
    """Gives the answers of a recording again.

    Args:
        recording: the recording.
        model: the world that it drives.
        ports: its open inputs.
        steps: the number of steps of the run.
        every: steps from one question to the next: an answer acts from such a step on.

    Raises:
        RecordingError: the stream cannot be what was sent to this world; it names the file, the row and the cause.
    """

    def __init__(
        self, recording: "Recording | Replayable", model: "mujoco.MjModel", ports: Ports, steps: int, every: int = 1
    ) -> None:
        import numpy as np

        asks = -(-steps // every)
        elements = sum(flat(model, name).size if kept is None else len(kept) for name, kept in ports.parameters)
        rooms = {"inputs": ports.width * asks, "edits": elements * asks}
        for name in ("inputs", "edits", *(OF_MEDIA if ports.media else ())):
            _whole(recording.folder / f"{name}.arrows", name, max(rooms[name], ENOUGH) if name in rooms else None)
        self._lasting = sum(len(ports.entries.get(name, ())) for name in HELD)
        self.vector = np.full(ports.width, np.nan)
        self.vector[: self._lasting] = 0.0
        inputs, edits = recording.inputs, recording.edits
        self._step, self._entry, self._value = (np.asarray(inputs[name]) for name in ("step", "entry", "value"))
        self._edits = [np.asarray(edits[name]) for name in ("step", "array", "index", "value")]
        ends = np.arange(steps + 1)
        found = [np.searchsorted(rows, ends) for rows in (self._step, self._edits[0])]
        # Read at every step, where a number of an array takes longer than one of a memory.
        self._ends, self._edit_ends = (rows.data for rows in found)
        self._spoken = np.logical_or(*(np.diff(rows) > 0 for rows in found)).tobytes()
        self._check_inputs(Rows(recording.folder / "inputs.arrows", self._step), steps, every)
        self._check_edits(Rows(recording.folder / "edits.arrows", self._edits[0]), model, ports, steps, every)
        self._media = ports.media
        self._told = _told(recording, ports.media, steps, every) if ports.media else {}

    def told(self, step: int) -> "np.ndarray | None":
        """What the laws told at this step, as `declared_media.Media.read` gives it; None when nothing."""
        return self._told.get(step)

    def _check_inputs(self, rows: "Rows", steps: int, every: int) -> None:
        import numpy as np

        entry, value, width = self._entry, self._value, len(self.vector)
        rows.due(steps, every)
        rows.refuse((entry < 0) | (entry >= width), f"its entry is none of the {width} that are declared", entry)
        again = np.zeros(len(entry), bool)
        again[1:] = (np.diff(self._step) == 0) & (np.diff(entry) <= 0)
        rows.refuse(again, "its entry is not after that of the row before, in the same step", entry)
        unwritten = np.isnan(value) & (entry >= self._lasting)  # of the state, it means that nothing was written
        rows.refuse(~np.isfinite(value) & ~unwritten, "its value is not finite", value)

    def _check_edits(self, rows: "Rows", model: "mujoco.MjModel", ports: Ports, steps: int, every: int) -> None:
        import numpy as np

        _, arrays, indices, values = self._edits
        rows.due(steps, every)
        declared = dict(ports.parameters)
        rows.refuse(~np.isin(arrays, list(declared)), "it edits what is no declared parameter", arrays)
        rows.refuse(~np.isfinite(values), "its value is not finite", values)
        by_place = np.lexsort((indices, arrays, rows.steps))
        again = np.zeros(len(arrays), bool)
        again[by_place[1:]] = np.logical_and.reduce(
            [c[by_place][1:] == c[by_place][:-1] for c in (indices, arrays, rows.steps)]
        )
        rows.refuse(again, "it edits in one step what was edited already", indices)
        for name in dict.fromkeys(arrays.tolist()):
            live, allowed, mine = flat(model, name), declared[name], arrays == name
            outside = (indices < 0) | (indices >= live.size)
            if allowed is not None:
                outside |= ~np.isin(indices, allowed)
            rows.refuse(mine & outside, f"it edits an element of {name} that is not declared", indices)
            with np.errstate(over="ignore", invalid="ignore"):
                kept = values.astype(live.dtype).astype(float)
            rows.refuse(mine & (kept != values), f"its value is none that {name} can hold", values)

    def speaks(self, step: int) -> bool:
        """Whether an answer acts from this step on."""
        return self._spoken[step] > 0

    def answer(self, step: int) -> "tuple[np.ndarray, list[Edit]]":
        """The vector and the edits that act from this step on; steps must come in their order."""
        import numpy as np

        vector, begin, end = self.vector, self._ends[step], self._ends[step + 1]
        if end - begin == len(vector):  # each entry is there once, in their order
            vector[:] = self._value[begin:end]
        else:
            vector[self._lasting :] = np.nan
            vector[self._entry[begin:end]] = self._value[begin:end]
        edits: list[Edit] = []
        begin, end = self._edit_ends[step], self._edit_ends[step + 1]
        if begin == end:
            return vector, edits
        _, arrays, indices, values = self._edits
        mine = slice(begin, end)
        for name in dict.fromkeys(arrays[mine].tolist()):
            these = arrays[mine] == name
            looks = any(part in name for part in LOOKS)
            edits.append(Edit(str(name), indices[mine][these].astype(np.intp), values[mine][these], looks_only=looks))
        return vector, edits


class Rows:
    """The rows of one file, by their steps, and the words for what is wrong with one of them."""

    def __init__(self, path: Path, steps: "np.ndarray", numbers: "np.ndarray | None" = None) -> None:
        self._path, self.steps, self._numbers = path, steps, numbers

    def due(self, steps: int, every: int) -> None:
        """Refuse steps that are not in their order, that the run never takes, or at which nobody is asked."""
        import numpy as np

        mine = self.steps
        self.refuse((mine < 0) | (mine >= steps), f"its step is none of the run's {steps}", mine)
        late = np.zeros(len(mine), bool)
        late[1:] = np.diff(mine) < 0
        self.refuse(late, "its step is before that of the row before", mine)
        self.refuse(mine % every != 0, f"its step is none at which the author is asked, every {every} steps", mine)

    def refuse(self, bad: "np.ndarray", cause: str, told: "np.ndarray") -> None:
        """Refuse the first row that is bad, with what it holds."""
        if bad.any():
            row = int(bad.argmax())
            number = row if self._numbers is None else int(self._numbers[row])
            where = f"{self._path.name}, row {number} (step {self.steps[row]})"
            raise RecordingError(f"{where}: {cause}: {told[row]}", str(self._path), REMEDY)


def _told(recording: "Recording | Replayable", media: "Media", steps: int, every: int) -> "dict[int, np.ndarray]":
    """What the laws told, by step: at each step that is due all points of all media in their order, and their sums."""
    import numpy as np

    due = np.arange(0, steps, every * media.every)
    if media.end is not None:
        due = np.append(due, steps)
    points, sums = recording.media, recording.balances
    count, mediums = sum(media.counts), len(media.counts)
    mine = np.flatnonzero(by_laws(points, mediums))
    _behind(Rows(recording.folder / "media.arrows", np.asarray(points["step"])), points, mediums)
    for name, table, each, numbers in (
        ("media", points, count, mine),
        ("balances", sums, mediums, np.arange(len(sums))),
    ):
        rows = Rows(recording.folder / f"{name}.arrows", np.asarray(table["step"])[numbers], numbers)
        which = np.repeat(np.arange(mediums), media.counts) if name == "media" else np.arange(mediums)
        if len(numbers) != each * len(due):
            cause = f"{name}.arrows has {len(numbers)} rows, and {len(due)} steps at which {each} are due"
            raise RecordingError(cause, str(recording.folder), REMEDY)
        rows.refuse(rows.steps != np.repeat(due, each), "it is of a step at which nothing is due", rows.steps)
        kinds = np.asarray(table["medium"])[numbers]
        rows.refuse(kinds != np.tile(which, len(due)), ANOTHER, kinds)
    rows = Rows(recording.folder / "media.arrows", np.asarray(points["step"])[mine], mine)
    order, point = np.concatenate([np.arange(n) for n in media.counts]), np.asarray(points["point"])[mine]
    rows.refuse(point != np.tile(order, len(due)), "it is of another point than is due", point)
    place = np.asarray(points["place"], float)[mine]
    rows.refuse(~(np.abs(place) < HUGE).all(axis=1), "it lies nowhere", place)
    colour = np.asarray(points["colour"], float)[mine]
    rows.refuse(point_colours.wrong(colour), "its colour is none", colour)
    rows = Rows(recording.folder / "balances.arrows", np.asarray(sums["step"]))
    columns = [np.asarray(sums[name], float).reshape(len(sums), -1) for name in SUMS]
    totals = np.concatenate(columns, axis=1)
    rows.refuse(~np.isfinite(totals).all(axis=1), "a sum is not finite", totals)
    place, colour, totals = (
        place.reshape(len(due), count, 3),
        colour.reshape(len(due), count),
        totals.reshape(len(due), mediums, -1),
    )
    ends = np.cumsum([0, *media.counts])
    return {
        int(step): np.concatenate(
            [
                part
                for m, mine in enumerate(map(slice, ends, ends[1:]))
                for part in (totals[n, m], place[n, mine].ravel(), colour[n, mine])
            ]
        )
        for n, step in enumerate(due)
    }


def _behind(rows: "Rows", points: "Table", mediums: int) -> None:
    """Refuse rows that are neither of a law nor of what a solver moves: that comes behind the laws at each step, from its first
    point on; a replay reckons it anew.
    """
    import numpy as np

    medium, point = (np.asarray(points[name]) for name in ("medium", "point"))
    beside = medium >= mediums
    follows = np.zeros(len(medium), bool)
    follows[1:] = (np.diff(rows.steps) == 0) & (np.diff(medium) == 0) & (np.diff(point) == 1)
    before = np.zeros(len(medium), bool)
    before[:-1] = (np.diff(rows.steps) == 0) & ~beside[1:]
    rows.refuse((medium < 0) | beside & (before | ~follows & (point != 0)), ANOTHER, medium)


def _whole(path: Path, name: str, rows: int | None) -> None:
    """Refuse a file that is torn, has more rows than can have been sent, or is no such table; one that is not there says that
    nothing was sent."""
    earlier = tuple(column for column in TABLES[name] if (name, column.name) not in LATER)
    forms = [arrow_schema(form) for form in (TABLES[name], FORETOLD_COLUMNS if name == "inputs" else earlier)]
    schema = stream_files.schema(path)
    if schema is not None and not any(schema.equals(form) for form in forms):
        raise RecordingError(f"{path.name} is no table of {name}: its columns are others", str(path), REMEDY)
    stream_files.batches(path, rows=rows)
