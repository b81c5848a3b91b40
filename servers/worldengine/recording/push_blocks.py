"""Keep what pushed as blocks of many steps and targets; the ledger's rows are made of them when they are read.

Six hundred pushed bodies have six hundred rows of the ledger at every step. Their times, kinds and names repeat, and their
numbers are noise that no packer makes smaller: as rows they cost forty times what it takes to compute them. A block is one
row of `pushes.arrows`, a stream of Arrow's that is not packed:

    kind     force, torque or control
    time     S times of states that were acted on, s
    target   B names
    acts     whether each of S x B is told, as bits, step by step, the highest bit of a byte first; empty where all are
    value    of those that are told, N: step by step the first numbers of the kind of all targets, then the second, …
    work_j   their N works, J

The rows of the table `interventions` (`columns`) are those N with their numbers in the kind's places (`PLACES`), zeros in the
others. Rows of one time come in the order control, force, torque, then what was noted as rows; within these by target.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

from .columns import VALUES

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping, Sequence

    import numpy as np

FILE = "pushes.arrows"
PLACES = {"control": slice(0, 2), "force": slice(0, 3), "torque": slice(3, 6)}
"""Where a kind's numbers lie in a row's values."""


class Block(NamedTuple):
    """What pushed in one way, over S steps and B targets."""

    kind: str
    time: "np.ndarray"
    """(S,) s."""
    targets: "Sequence[str]"
    acts: "np.ndarray"
    """(S, B) bool."""
    numbers: "np.ndarray"
    """(S, W, B) with as many W as the kind has."""
    works: "np.ndarray"
    """(S, B) J."""


class PushStream:
    """Writes the file; `counts` has the rows by kind."""

    def __init__(self, folder: Path) -> None:
        import pyarrow as pa

        floats = pa.list_(pa.float64())
        fields = {"kind": pa.string(), "time": floats, "target": pa.list_(pa.string()), "acts": pa.binary()}
        self._schema = pa.schema({**fields, "value": floats, "work_j": floats})
        self._sink = pa.OSFile(str(folder / FILE), "wb")
        self._writer = pa.ipc.new_stream(self._sink, self._schema)
        self.counts: dict[str, int] = {}

    def write(self, blocks: "Iterable[Block]") -> None:
        """Append blocks; one of which nothing acts is left out."""
        import numpy as np
        import pyarrow as pa

        def listed(values: Any) -> Any:
            flat = pa.array(values)
            return pa.ListArray.from_arrays(pa.array([0, len(flat)], pa.int32()), flat)

        for kind, time, targets, acts, numbers, works in blocks:
            told = int(np.count_nonzero(acts))
            if not told:
                continue
            self.counts[kind] = self.counts.get(kind, 0) + told
            bits = b""
            if told < acts.size:
                bits = np.packbits(acts).tobytes()
                numbers, works = numbers[np.broadcast_to(acts[:, None], numbers.shape)], works[acts]
            columns = [pa.array([kind]), listed(time), listed(targets), pa.array([bits], pa.binary())]
            columns += [listed(numbers.reshape(-1)), listed(works.reshape(-1))]
            self._writer.write_batch(pa.RecordBatch.from_arrays(columns, schema=self._schema))

    def close(self) -> None:
        """End the file."""
        if not self._sink.closed:
            self._writer.close()
            self._sink.close()


def join(table: Any, batches: "Iterable[Any]") -> "Mapping[str, np.ndarray]":
    """The columns of the table of interventions (`stored.Table`) with the rows of the blocks among its own, in the order of their times."""
    import numpy as np

    parts = [_rows(batch, n) for batch in batches for n in range(batch.num_rows)]
    if not parts:
        return {}
    order: np.ndarray | None = None
    columns: dict[str, np.ndarray] = {}
    for name in table.columns:  # `time` first; a part's column goes once it is joined: the ledger of a crowd is large
        columns[name] = np.concatenate([*(part.pop(name) for part in parts), table[name]])
        if name == "time":
            order = np.argsort(columns[name], kind="stable")
            if np.array_equal(order, np.arange(len(order))):
                order = None
        if order is not None:
            columns[name] = columns[name][order]
    return columns


def _rows(batch: Any, n: int) -> "dict[str, np.ndarray]":
    """Rows of one block."""
    import numpy as np

    def numbers(name: str) -> "np.ndarray":
        return np.asarray(batch[name][n].values.to_numpy())

    kind, time = batch["kind"][n].as_py(), numbers("time")
    targets = np.array(batch["target"][n].as_py(), dtype=str)
    shape, bits = (len(time), len(targets)), np.frombuffer(batch["acts"][n].as_py(), np.uint8)
    acts = np.unpackbits(bits, count=shape[0] * shape[1]).reshape(shape) > 0 if len(bits) else np.ones(shape, bool)
    step, which = np.nonzero(acts)
    found, value = numbers("value"), np.zeros((len(step), VALUES))
    every = np.broadcast_to(acts[:, None], (shape[0], len(found) // len(step), shape[1]))
    numbered = np.zeros(every.shape)
    numbered[every] = found
    value[:, PLACES[kind]] = numbered.swapaxes(1, 2)[acts]
    return {
        "time": time[step],
        "kind": np.full(len(step), kind),
        "target": targets[which],
        "value": value,
        "work_j": numbers("work_j"),
    }
