"""Vectors in LanceDB, where the `semantic` extra is installed: for hundreds of thousands of forum posts and source files.

Rows are appended in batches. The search itself is an exact product of matrices in memory; LanceDB's own flat scan of
12,000 rows took 65 ms, more than the whole answer may.
"""

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


def stamp() -> float:
    """A text that changes when vectors are added."""
    versions = folder() / f"{TABLE}.lance" / "_versions"
    return versions.stat().st_mtime if versions.is_dir() else 0.0


def known() -> set[str]:
    """Every stored digest."""
    table = _open()
    return set() if table is None else set(table.to_arrow().column("digest").to_pylist())


def everything() -> "tuple[list[str], np.ndarray]":
    """Every digest, and their vectors (N, 384) float32."""
    import numpy as np

    table = _open()
    if table is None:
        return [], np.zeros((0, DIMENSIONS), dtype=np.float32)
    rows = table.to_arrow()
    column = rows.column("vector").combine_chunks()
    vectors = column.values.to_numpy(zero_copy_only=False).reshape(-1, DIMENSIONS)
    return rows.column("digest").to_pylist(), vectors.astype(np.float32, copy=False)


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
