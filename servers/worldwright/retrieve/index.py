"""The full-text index: one SQLite file per content of the corpus, built once, opened read-only by everyone.

BM25 comes from SQLite's FTS5. Three columns are weighed differently: the headings and labels of a piece, the
identifiers in it (whole and in parts), and its words (stemmed).
"""

import os
import sqlite3
import tempfile
import time
from collections.abc import Iterator
from contextlib import closing, contextmanager, suppress
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ..model.errors import WorldwrightError
from ..model.progress import Progress, silent
from ..simulator.cache import cache_folder
from . import corpus, words

FORMAT = "3"
"""Part of the index's name: changes when its tables or the cutting do."""
WEIGHTS = "5.0, 2.5, 1.0"
"""BM25 weights of the columns title, names, body."""
KEPT = 4
"""Older indexes beyond this many are removed."""

_TABLES = """
CREATE TABLE piece (id INTEGER PRIMARY KEY, root TEXT, path TEXT, part TEXT, anchor TEXT, first INTEGER, last INTEGER,
                    title TEXT, text TEXT);
CREATE TABLE label (name TEXT, lower TEXT, piece INTEGER);
CREATE VIRTUAL TABLE words USING fts5(title, names, body, tokenize="porter unicode61 tokenchars '_'");
"""


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

    def search(self, expression: str, limit: int) -> list[tuple[int, float]]:
        """(piece id, BM25 score, larger is better) for a match expression."""
        if not expression:
            return []
        query = f"SELECT rowid, bm25(words, {WEIGHTS}) AS cost FROM words WHERE words MATCH ? ORDER BY cost LIMIT ?"
        with self.reading() as db:
            return [(row[0], -row[1]) for row in db.execute(query, (expression, limit))]

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
    found = corpus.documents()
    path = index_path(corpus.fingerprint(found))
    if not (path.is_file() and _usable(path)):
        _build(path, found, progress)
        _tidy(path)
        _usable.cache_clear()
    with suppress(OSError):
        path.touch()  # another installation may be tidying: this one is in use
    return Index(path)


def index_path(fingerprint: str) -> Path:
    """Where the index of a corpus lies."""
    return cache_folder() / f"retrieve-{FORMAT}-{fingerprint[:16]}.sqlite"


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
            for done, document in enumerate(found):
                progress(done, len(found), f"indexing {document.path}")
                for chunk in document.chunks():
                    number += 1
                    row = (number, document.root, document.path, document.part, chunk.anchor, chunk.start, chunk.end)
                    db.execute("INSERT INTO piece VALUES (?,?,?,?,?,?,?,?,?)", (*row, chunk.title, chunk.text))
                    labels = {*chunk.labels, chunk.anchor}
                    db.executemany("INSERT INTO label VALUES (?,?,?)", [(n, n.lower(), number) for n in labels])
                    spoken = " ".join(" ".join(words.tokens(name)) + " " + name.replace("-", " ") for name in labels)
                    title = f"{chunk.title} {spoken}"
                    db.execute(
                        "INSERT INTO words(rowid, title, names, body) VALUES (?,?,?,?)",
                        (number, title, words.names(f"{title} {chunk.text}"), chunk.text),
                    )
        db.execute("INSERT INTO words(words) VALUES('optimize')")
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
