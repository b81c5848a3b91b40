"""Embedding what is not embedded yet: in this process with progress, or in a quiet one beside a server."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from functools import cache

from ...model.progress import Progress, silent
from ..index import Index, open_index
from . import store
from .model import encode

BATCH = 256


def missing(index: Index) -> dict[str, str]:
    """Texts without a vector, by digest."""
    stored = store.known()
    return {digest: text for digest, text in index.window_texts().items() if digest not in stored}


def prepare(index: Index | None = None, progress: Progress = silent) -> int:
    """Embed what is missing (about a minute for everything on two cores); returns how many were embedded here."""
    index = index or open_index(progress)
    with store.building() as mine:
        if not mine:
            return 0
        todo = sorted(missing(index).items(), key=lambda row: len(row[1]))  # sentences of similar length together
        batches = [todo[start : start + BATCH] for start in range(0, len(todo), BATCH)]
        done = 0
        with ThreadPoolExecutor(_workers()) as pool:
            for batch, vectors in zip(
                batches, pool.map(lambda b: encode([text for _, text in b]), batches), strict=True
            ):
                store.append([digest for digest, _ in batch], vectors)
                done += len(batch)
                progress(done, len(todo), "embedding the corpus")
        return len(todo)


def _workers() -> int:
    """How many batches run at a time: what is not a matrix product runs on one core each."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@cache
def prepare_beside() -> None:
    """Start `worldwright index` once, at low priority and outliving us: a server goes on answering by full text."""
    command = [sys.executable, "-P", "-m", "worldwright.cli", "index"]
    if os.name == "posix":
        command = ["nice", "-n", "15", *command]
    subprocess.Popen(
        command,
        stdin=subprocess.DEVNULL,
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
        start_new_session=True,
    )
