"""Pieces by the nearness of their meaning to the question's: cosine of sentence vectors, best window of each piece."""

import threading
import time
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING

from ...model.progress import Progress, silent
from .. import thesaurus
from ..index import Index, open_index
from . import installed, preparing, store
from .model import encode
from .windows import digest

if TYPE_CHECKING:
    import numpy as np

ENOUGH = 0.98
"""Share of the windows that must have vectors before the ranking is worth joining."""


@dataclass(frozen=True)
class Space:
    """Every window's vector, and the piece it belongs to."""

    owners: "np.ndarray"
    """(N,) piece ids."""
    vectors: "np.ndarray"
    """(N, 384) float32, unit length."""
    share: float
    """Of the windows, those that have a vector."""

    @property
    def enough(self) -> bool:
        """Whether the ranking is worth joining."""
        return self.share >= ENOUGH


@dataclass(frozen=True)
class Vectors:
    """Ranks by a space of vectors."""

    space: Space

    def rank(self, index: Index, question: str, limit: int) -> list[tuple[int, float]]:
        """(piece id, cosine), best first."""
        import numpy as np

        if not question.strip() or not len(self.space.owners):
            return []
        meant = ", ".join(thesaurus.expand(question))
        near = self.space.vectors @ encode([f"{question[:1000]} ({meant})" if meant else question[:1000]])[0]
        found: dict[int, float] = {}
        for row in np.argsort(-near, kind="stable")[: 4 * limit]:
            found.setdefault(int(self.space.owners[row]), float(near[row]))
            if len(found) == limit:
                break
        return list(found.items())


@cache
def _space(path: str, stamp: float) -> Space:
    """The space of one index; `stamp` changes when vectors are added."""
    from pathlib import Path

    import numpy as np

    owners, found = preparing.texts(Index(Path(path)))
    rows, vectors = store.load([digest(text) for text in found])
    return Space(np.array(owners, dtype=np.int64)[rows], vectors, len(rows) / max(1, len(found)))


def space(index: Index) -> Space:
    """The vectors of an index as far as they are made."""
    versions = store.folder() / f"{store.TABLE}.lance" / "_versions"
    return _space(str(index.path), versions.stat().st_mtime if versions.is_dir() else 0.0)


def wait(progress: Progress = silent) -> Vectors:
    """The ranker, after embedding what is missing and loading the model."""
    index = open_index(progress)
    found = space(index)
    deadline = time.monotonic() + 900
    while found.share < 1.0 and time.monotonic() < deadline:
        if preparing.prepare(index, progress) == 0:
            time.sleep(1.0)  # another process is at it
        found = space(index)
    encode(["warm"])
    return Vectors(found)


class Background:
    """The ranker a server gets: none until model and vectors are there, never a pause."""

    def __init__(self) -> None:
        self._ready: Vectors | None = None
        self._path = ""
        self._thread: threading.Thread | None = None
        self.enabled = False
        """Set by a process that lives long enough for loading to pay."""

    def get(self, index: Index) -> Vectors | None:
        """The ranker for this index, or None while it is being made."""
        if self._ready is not None and self._path == str(index.path):
            return self._ready
        if self.enabled and installed() and (self._thread is None or not self._thread.is_alive()):
            self._thread = threading.Thread(target=self._load, args=(index,), daemon=True)
            self._thread.start()
        return None

    def adopt(self, ranker: Vectors | None, index: Index) -> None:
        """Use a ranker that was waited for, or none."""
        self._ready, self._path = ranker, str(index.path)

    def _load(self, index: Index) -> None:
        found = space(index)
        if found.share < 1.0:
            preparing.prepare_beside()
            while not found.enough:
                time.sleep(2.0)
                found = space(index)
        encode(["warm"])
        self.adopt(Vectors(found), index)


BACKGROUND = Background()
