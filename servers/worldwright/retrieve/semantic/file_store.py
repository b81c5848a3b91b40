"""Vectors in one SQLite file, which needs nothing installed and is read whole in a few hundredths of a second."""

import sqlite3
from contextlib import closing, suppress
from pathlib import Path
from typing import TYPE_CHECKING

from ...simulator.cache import cache_folder
from .model import DIMENSIONS, NAME

if TYPE_CHECKING:
    import numpy as np

FORMAT = "1"
_TABLE = "CREATE TABLE IF NOT EXISTS vector (digest TEXT PRIMARY KEY, numbers BLOB)"


def path() -> Path:
    """Where the file lies."""
    return cache_folder() / f"vectors-{FORMAT}-{NAME.lower()}.sqlite"


def stamp() -> float:
    """A text that changes when vectors are added."""
    return path().stat().st_mtime if path().is_file() else 0.0


def known() -> set[str]:
    """Every stored digest."""
    return {row[0] for row in _rows("SELECT digest FROM vector")}


def everything() -> "tuple[list[str], np.ndarray]":
    """Every digest, and their vectors (N, 384) float32."""
    import numpy as np

    rows = _rows("SELECT digest, numbers FROM vector")
    packed = np.frombuffer(b"".join(row[1] for row in rows), dtype=np.float16)
    return [row[0] for row in rows], packed.reshape(-1, DIMENSIONS).astype(np.float32)


def append(digests: list[str], vectors: "np.ndarray") -> None:
    """Store a batch; half precision moves a cosine by less than 0.001."""
    packed = [row.tobytes() for row in vectors.astype("float16")]
    with closing(sqlite3.connect(path(), timeout=30.0)) as db, db:
        db.execute(_TABLE)
        db.executemany("INSERT OR IGNORE INTO vector VALUES (?,?)", zip(digests, packed, strict=True))


def _rows(query: str) -> list[tuple]:
    """Rows of the file; none before the first batch, or while another holds it; a damaged file counts as none and is made anew."""
    if not path().is_file():
        return []
    try:
        with closing(sqlite3.connect(path(), timeout=30.0)) as db:
            db.execute(_TABLE)
            return db.execute(query).fetchall()
    except sqlite3.OperationalError:  # held by another, or on a disk that gives nothing: what lies there is whole
        return []
    except sqlite3.DatabaseError:
        with suppress(OSError):
            path().unlink(missing_ok=True)
        return []
