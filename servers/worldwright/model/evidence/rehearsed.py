"""Rehearsals: a run's world built, simulated and measured before anybody has approved its plan.

A rehearsal is a run folder of its own, `rehearsal/` inside the run, whose journal begins with the line `rehearse`; the line
`laid` follows when all its files lie there. Physics of such a folder needs no approval; in exchange nothing of it is ever
approved or accepted, and no line, report or recording of it lies where those of the run are looked for. `worldwright gc`
removes it.
"""

import os
import time
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from .. import try_lock
from .run import Run

FOLDER, ACTION, LAID = "rehearsal", "rehearse", "laid"
POLL_S = 0.1


def folder(run: Path) -> Path:
    """Where a run's rehearsal lies."""
    return run / FOLDER


def is_one(entries: Iterable[Mapping[str, Any]]) -> bool:
    """Whether a journal is that of a rehearsal."""
    return any(entry.get("action") == ACTION for entry in entries)


def of(run: Path) -> Run | None:
    """A run's rehearsal; None where there is none, and where what lies there is a link or somebody's own."""
    here = folder(run)
    if here.is_dir() and not here.is_symlink():
        with suppress(OSError):  # of what cannot be read nobody knows that it is one
            found = Run(here)
            if not found.journal.is_symlink() and next(found.entries(), {}).get("action") == ACTION:
                return found
    return None


@contextmanager
def alone(here: Path, until: float = 0.0) -> Iterator[bool]:
    """Let one caller at a time work on a rehearsal's folder, which is made if need be.

    Args:
        here: the folder.
        until: wait for another caller until then, by the monotonic clock, s.

    Yields:
        Whether nobody else works there.
    """
    while True:
        here.mkdir(exist_ok=True)
        handle = os.open(here, os.O_RDONLY | os.O_DIRECTORY | os.O_NOFOLLOW)
        try:
            if try_lock.taken(handle) and here.is_dir() and here.stat().st_ino == os.fstat(handle).st_ino:
                yield True
                return
        finally:  # taken by another; or it was removed meanwhile, and what was taken is no more
            os.close(handle)
        if time.monotonic() >= until:
            break
        time.sleep(POLL_S)
    yield False
