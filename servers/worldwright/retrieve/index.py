"""The index: one SQLite file per content of the corpus, built once, opened read-only by everyone.

It holds the pieces, the labels that lead to them, every term with the windows it stands in and its share of their scores
(`lexical`), and the texts that are embedded (`semantic`).
"""

import os
import sqlite3
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path
from typing import TYPE_CHECKING

from ..model import call_time
from ..model.errors import WorldwrightError
from ..model.progress import Progress, silent
from ..simulator.cache import cache_folder, held
from . import corpus, lexical
from .semantic.windows import digest, windows

if TYPE_CHECKING:
    import numpy as np

FORMAT = "8"
"""Part of the index's name; it changes when the tables do, or the cutting."""
KEPT = 4
"""Older indexes beyond this many are removed."""
PATIENCE_S = 15.0
"""Another builder is waited for so long, s: many times what building takes."""

_TABLES = """
CREATE TABLE piece (id INTEGER PRIMARY KEY, root TEXT, path TEXT, part TEXT, anchor TEXT, first INTEGER, last INTEGER,
                    title TEXT, text TEXT);
CREATE TABLE label (name TEXT, lower TEXT, piece INTEGER);
CREATE TABLE term (name TEXT PRIMARY KEY, windows BLOB, shares BLOB) WITHOUT ROWID;
CREATE TABLE start (window INTEGER);
CREATE TABLE meant (piece INTEGER, digest TEXT, text TEXT);
"""
_ORDERED = """
CREATE INDEX standing ON piece (root, path, anchor);
CREATE INDEX spelt ON label (name);
CREATE INDEX lowered ON label (lower);
"""
"""What a citation and a name are looked up by: each would else read the whole file, texts included, some 4 ms a time."""


class SearchIndexError(WorldwrightError):
    """The full-text index cannot be built or read."""

    code = "index"


@dataclass(frozen=True)
class Piece:
    """A stored chunk."""

    id: int
    root: str
    path: str
    part: str
    anchor: str
    first: int
    last: int
    title: str
    text: str

    @property
    def citation(self) -> str:
        """Stable name that `read` opens."""
        return f"{self.root}/{self.path}#{self.anchor}:L{self.first}-L{self.last}"


class Index:
    """Look-ups in one index file."""

    def __init__(self, path: Path) -> None:
        self.path = path

    @contextmanager
    def reading(self) -> Iterator[sqlite3.Connection]:
        """A read-only connection (one per call: connections do not travel between threads)."""
        try:
            with closing(sqlite3.connect(f"{self.path.as_uri()}?mode=ro&immutable=1", uri=True)) as connection:
                yield connection
        except sqlite3.DatabaseError as cause:
            self.path.unlink(missing_ok=True)
            raise SearchIndexError(
                f"the full-text index is damaged: {cause}",
                place=str(self.path),
                next_move="ask again: it was removed and will be built anew",
            ) from cause

    def scores(self, weights: dict[str, float]) -> "np.ndarray":
        """BM25 of every piece's best window for weighted terms: entry n belongs to piece n, entry 0 to none."""
        import numpy as np

        marks = ",".join("?" * len(weights))
        with self.reading() as db:
            rows = db.execute(f"SELECT name, windows, shares FROM term WHERE name IN ({marks})", list(weights))
            stored = {name: (windows, shares) for name, windows, shares in rows}
        *starts, count = _starts(self.path)
        return np.maximum.reduceat(lexical.score(stored, weights, count), starts)

    def telling(self, weights: dict[str, float]) -> dict[str, float]:
        """How much each weighted term tells: its weight times its rarity, for the terms that occur at all."""
        marks = ",".join("?" * len(weights))
        with self.reading() as db:
            rows = db.execute(f"SELECT name, length(windows) / 4 FROM term WHERE name IN ({marks})", list(weights))
            return {name: weights[name] * lexical.rarity(times, _starts(self.path)[-1]) for name, times in rows}

    def named(self, names: list[str]) -> list[int]:
        """Pieces that stand under one of these names, in any case."""
        marks = ",".join("?" * len(names))
        with self.reading() as db:
            rows = db.execute(f"SELECT piece FROM label WHERE lower IN ({marks})", [name.lower() for name in names])
            return sorted({row[0] for row in rows})

    def places(self) -> list[tuple[int, str, str, str, str, int]]:
        """(number, root, path, part, anchor, first line) of every piece, in order."""
        with self.reading() as db:
            return db.execute("SELECT id, root, path, part, anchor, first FROM piece ORDER BY id").fetchall()

    def windows(self) -> list[tuple[int, str]]:
        """(piece, digest) of every text that is embedded."""
        with self.reading() as db:
            return db.execute("SELECT piece, digest FROM meant").fetchall()

    def window_texts(self) -> dict[str, str]:
        """Every text that is embedded, by its digest."""
        with self.reading() as db:
            return dict(db.execute("SELECT digest, text FROM meant"))

    def pieces(self, ids: list[int]) -> dict[int, Piece]:
        """Stored chunks by id."""
        marks = ",".join("?" * len(ids))
        with self.reading() as db:
            rows = db.execute(f"SELECT * FROM piece WHERE id IN ({marks})", ids).fetchall()
        return {row[0]: Piece(*row) for row in rows}

    def every(self) -> Iterator[Piece]:
        """Every stored chunk, in order."""
        with self.reading() as db:
            for row in db.execute("SELECT * FROM piece ORDER BY id"):
                yield Piece(*row)

    def labelled(self, *names: str) -> list[Piece]:
        """Pieces a label leads to, exact spelling first, then any case."""
        found: dict[int, Piece] = {}
        with self.reading() as db:
            for column, wanted in (("name", names), ("lower", tuple(name.lower() for name in names))):
                for name in wanted:
                    query = f"SELECT piece.* FROM label JOIN piece ON piece.id = label.piece WHERE label.{column} = ?"
                    for row in db.execute(query, (name,)):
                        found.setdefault(row[0], Piece(*row))
        return list(found.values())

    def at(self, root: str, path: str, anchor: str) -> list[Piece]:
        """The pieces under an anchor of a document, in the order of its lines."""
        query = "SELECT * FROM piece WHERE root = ? AND path = ? AND anchor = ? ORDER BY first"
        with self.reading() as db:
            return [Piece(*row) for row in db.execute(query, (root, path, anchor))]

    def counts(self) -> dict[str, int]:
        """Pieces by part of the corpus."""
        with self.reading() as db:
            return dict(db.execute("SELECT part, count(*) FROM piece GROUP BY part ORDER BY part"))


def open_index(progress: Progress = silent) -> Index:
    """The index of the corpus as it is now; built first when its content is new (about a second)."""
    path = index_path(corpus.fingerprint())
    if not (path.is_file() and _usable(path)):
        # One after the other: who waits finds it built. Who has waited in vain builds it all the same.
        with held("retrieve.lock", min(PATIENCE_S, call_time.left_s())):
            _usable.cache_clear()
            if not _usable(path):  # nobody else has built it meanwhile
                _build(path, corpus.documents(), progress)
                _tidy(path)
                _usable.cache_clear()
    with suppress(OSError):
        path.touch()  # another installation may be removing old ones: this one is in use
    return Index(path)


def index_path(fingerprint: str) -> Path:
    """Where the index of a corpus lies."""
    return cache_folder() / f"retrieve-{FORMAT}-{fingerprint[:16]}.sqlite"


@lru_cache(maxsize=2)
def _starts(path: Path) -> list[int]:
    """Each piece's first window by the piece's number (window 0 is no piece's); at the end the number of windows."""
    with Index(path).reading() as db:
        return [row[0] for row in db.execute("SELECT window FROM start ORDER BY rowid")]


@cache
def _usable(path: Path) -> bool:
    """Whether a whole index lies there; a damaged one counts as missing."""
    if not path.is_file():
        return False
    try:
        return sum(Index(path).counts().values()) > 0
    except SearchIndexError:
        return False


def _build(path: Path, found: list[corpus.Document], progress: Progress) -> None:
    handle, name = tempfile.mkstemp(dir=path.parent, prefix=f".{path.name}.")
    os.close(handle)
    try:
        db = sqlite3.connect(name)
        db.executescript("PRAGMA journal_mode = OFF; PRAGMA synchronous = OFF;" + _TABLES)
        number = 0
        with db:
            said: list[lexical.Fields] = []
            starts = [0]
            for done, document in enumerate(found):
                progress(done, len(found), f"indexing {document.path}")
                for chunk in document.chunks():
                    number += 1
                    row = (number, document.root, document.path, document.part, chunk.anchor, chunk.start, chunk.end)
                    db.execute("INSERT INTO piece VALUES (?,?,?,?,?,?,?,?,?)", (*row, chunk.title, chunk.text))
                    labels = {*chunk.labels, chunk.anchor}
                    db.executemany("INSERT INTO label VALUES (?,?,?)", [(n, n.lower(), number) for n in labels])
                    starts.append(len(said) + 1)
                    said += lexical.fields(chunk)
                    meant = windows(chunk, document.part, document.path)
                    db.executemany("INSERT INTO meant VALUES (?,?,?)", [(number, digest(t), t) for t in meant])
            db.executemany("INSERT INTO start VALUES (?)", [(start,) for start in (*starts, len(said))])
            db.executemany("INSERT INTO term VALUES (?,?,?)", lexical.shares(said))
        db.executescript(_ORDERED)
        db.commit()
        db.close()
        Path(name).replace(path)
    except (OSError, sqlite3.Error) as cause:
        Path(name).unlink(missing_ok=True)
        raise SearchIndexError(
            f"the full-text index cannot be built: {cause}",
            place=str(path),
            next_move="free some space there, or name another folder with WORLDWRIGHT_CACHE",
        ) from cause
    progress(len(found), len(found), "indexed")


def _tidy(current: Path) -> None:
    """Remove indexes of older contents, keeping the newest few (others may still have them open)."""
    try:
        old = sorted(current.parent.glob("retrieve-*.sqlite"), key=lambda p: p.stat().st_mtime, reverse=True)
        unused = [p for p in old if p != current and p.stat().st_mtime < time.time() - 3600]
        abandoned = [p for p in current.parent.glob(".retrieve-*") if p.stat().st_mtime < time.time() - 3600]
    except OSError:
        return
    for path in unused[KEPT - 1 :] + abandoned:
        path.unlink(missing_ok=True)
