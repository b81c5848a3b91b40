"""Embedding what is not embedded yet: in this process with progress, or in a quiet one beside a server."""

import os
import subprocess
import sys
from functools import cache

from ...model.progress import Progress, silent
from ..index import Index, open_index
from . import store
from .model import encode
from .windows import digest, windows

BATCH = 512


def texts(index: Index) -> tuple[list[int], list[str]]:
    """(piece of each window, its text), every window of an index in order."""
    owners: list[int] = []
    found: list[str] = []
    for piece in index.every():
        for text in windows(piece):
            owners.append(piece.id)
            found.append(text)
    return owners, found


def missing(index: Index) -> dict[str, str]:
    """Texts without a vector, by digest."""
    stored = store.known()
    return {d: text for text in texts(index)[1] if (d := digest(text)) not in stored}


def prepare(index: Index | None = None, progress: Progress = silent) -> int:
    """Embed what is missing (about 100 windows a second on two cores); returns how many were embedded here."""
    index = index or open_index(progress)
    with store.building() as mine:
        if not mine:
            return 0
        todo = sorted(missing(index).items(), key=lambda row: len(row[1]))  # like lengths together: less padding
        for start in range(0, len(todo), BATCH):
            progress(start, len(todo), "embedding the corpus")
            batch = todo[start : start + BATCH]
            store.append([d for d, _ in batch], encode([text for _, text in batch]))
        progress(len(todo), len(todo), "embedded")
        return len(todo)


@cache
def prepare_beside() -> None:
    """Start `worldwright index` once, at low priority and outliving us: a server goes on answering by full text."""
    command = [sys.executable, "-m", "worldwright.cli", "index"]
    if os.name == "posix":
        command = ["nice", "-n", "15", *command]
    subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
