"""Vectors on disk, in LanceDB, each under the digest of its text: what has been embedded is never embedded again.

A new simulator version, an edited skill or an added repository costs only the texts that are new. Rows are appended
in batches, so that an interrupted build goes on where it stopped.

The search itself is an exact product of matrices in memory (about 12,000 windows: 2 ms); LanceDB's own flat scan of the
same rows took 65 ms, more than the whole answer may.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ...simulator.cache import cache_folder
from .model import DIMENSIONS, NAME

if TYPE_CHECKING:
    import numpy as np

FORMAT = "1"
TABLE = "windows"


def folder() -> Path:
    """Where the database lies."""
    return cache_folder() / f"vectors-{FORMAT}-{NAME.lower()}"


def known() -> dict[str, int]:
    """Row of every stored digest."""
    table = _open()
    return {} if table is None else {d: n for n, d in enumerate(table.to_arrow().column("digest").to_pylist())}


def load(digests: list[str]) -> "tuple[np.ndarray, np.ndarray]":
    """The vectors of the digests that are stored.

    Returns:
        (indices into `digests` (M,), unit vectors (M, 384) float32).
    """
    import numpy as np

    table = _open()
    if table is None:
        return np.zeros(0, dtype=np.int64), np.zeros((0, DIMENSIONS), dtype=np.float32)
    rows = table.to_arrow()
    place = {digest: number for number, digest in enumerate(rows.column("digest").to_pylist())}
    column = rows.column("vector").combine_chunks()
    stored = column.values.to_numpy(zero_copy_only=False).reshape(-1, DIMENSIONS)
    found = [(n, place[d]) for n, d in enumerate(digests) if d in place]
    return (
        np.array([n for n, _ in found], dtype=np.int64),
        np.ascontiguousarray(stored[[row for _, row in found]], dtype=np.float32),
    )


def append(digests: list[str], vectors: "np.ndarray") -> None:
    """Store a batch."""
    import pyarrow as pa

    values = pa.FixedSizeListArray.from_arrays(pa.array(vectors.astype("float32").ravel()), DIMENSIONS)
    batch = pa.table({"digest": pa.array(digests, pa.string()), "vector": values})
    table = _open()
    if table is None:
        _database().create_table(TABLE, batch, exist_ok=True)
    else:
        table.add(batch)


@contextmanager
def building() -> Iterator[bool]:
    """Whether this process may build now (True), or another one does (False)."""
    import fcntl

    path = cache_folder() / f"{folder().name}.lock"
    with path.open("w") as handle:
        try:
            fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            yield False
            return
        yield True


def _database() -> Any:
    import lancedb

    return lancedb.connect(folder())


def _open() -> Any:
    """The table, or None before the first batch; a damaged database counts as none and is made anew."""
    if not folder().is_dir():
        return None
    try:
        return _database().open_table(TABLE)
    except (ValueError, FileNotFoundError):
        return None
    except (OSError, RuntimeError):
        import shutil

        shutil.rmtree(folder(), ignore_errors=True)
        return None
