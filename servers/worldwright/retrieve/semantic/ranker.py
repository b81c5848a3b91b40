"""Ranking pieces by meaning: the cosine between the question's vector and the nearest window of each piece."""

import threading
from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

from ...model.progress import Progress, silent
from ..index import Index, open_index
from . import installed, preparing, store
from .model import encode

if TYPE_CHECKING:
    import numpy as np

ENOUGH = 0.98
"""Share of the windows that must have vectors before the ranking is worth joining."""
LASTING = threading.Event()
"""Set by a process that lives long enough to have missing vectors made beside it."""


@dataclass(frozen=True)
class Space:
    """Every window's vector, and the piece it belongs to."""

    owners: "np.ndarray"
    """(N,) piece numbers."""
    vectors: "np.ndarray"
    """(N, 384) float32, unit length."""
    share: float
    """Share of the windows that have a vector."""

    def near(self, question: str, count: int) -> "np.ndarray":
        """(count + 1,) float32: the best cosine of each piece's windows; 0 where it has none."""
        import numpy as np

        found = np.zeros(count + 1, dtype=np.float32)
        if question.strip() and len(self.owners):
            np.maximum.at(found, self.owners, self.vectors @ encode([question[:1000]])[0])
        return found


@lru_cache(maxsize=2)
def _space(path: str, _stamp: float) -> Space:
    """The space of one index; `_stamp` changes when vectors are added."""
    from pathlib import Path

    import numpy as np

    digests, vectors = store.everything()
    row = {digest: number for number, digest in enumerate(digests)}
    wanted = Index(Path(path)).windows()
    found = [(piece, row[digest]) for piece, digest in wanted if digest in row]
    owners = np.array([piece for piece, _ in found], dtype=np.int64)
    chosen = vectors[[number for _, number in found]] if found else vectors[:0]
    return Space(owners, chosen, len(found) / max(1, len(wanted)))


def space(index: Index) -> Space:
    """The vectors of an index that are there so far."""
    return _space(str(index.path), store.stamp())


def wait(index: Index, progress: Progress = silent) -> Space:
    """The space, after embedding what is missing."""
    import time

    deadline = time.monotonic() + 900
    while space(index).share < 1.0 and time.monotonic() < deadline:
        if preparing.prepare(index, progress) == 0:
            time.sleep(1.0)  # another process is embedding
    return space(index)


def ready(index: Index) -> Space | None:
    """The space at once when it is worth joining; else None, and a server has the rest embedded in another process."""
    if not installed():
        return None
    found = space(index)
    if found.share < 1.0 and LASTING.is_set():
        preparing.prepare_beside()
    return found if found.share >= ENOUGH else None


def warm() -> None:
    """Load model and space ahead of the first question; a server does it beside its start."""
    if installed():
        ready(open_index())
        encode(["warm"])
