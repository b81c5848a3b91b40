"""Keep tables and indexes, which are made from the installed packages, between runs."""

import hashlib
import json
import os
import tempfile
import time
from collections.abc import Callable, Iterator
from contextlib import ExitStack, contextmanager, suppress
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model import try_lock

KEPT = 4
"""So many tables of other versions stay beside the newest, as several environments may share the folder."""


def cache_folder() -> Path:
    """`$WORLDWRIGHT_CACHE`, else the user's cache directory, else (when neither can be written) a temporary one."""
    named = os.environ.get("WORLDWRIGHT_CACHE")
    home = os.environ.get("XDG_CACHE_HOME") or Path("~/.cache").expanduser()
    owner = os.getuid() if hasattr(os, "getuid") else "user"
    fallback = Path(tempfile.gettempdir()) / f"worldwright-{owner}"
    for folder in (Path(named) if named else Path(home) / "worldwright", fallback):
        try:
            folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        except OSError:
            continue
        mine = not hasattr(os, "getuid") or folder.stat().st_uid == os.getuid()
        if mine and os.access(folder, os.W_OK):
            return folder
    return Path(tempfile.mkdtemp(prefix="worldwright-"))


def cached_json(name: str, key: str, build: Callable[[], Any]) -> Any:
    """The JSON value that `build()` makes for `key`, from disk if it was made before.

    An unreadable or damaged file counts as missing. A cache that cannot be written costs time, never the answer.
    """
    path = cache_folder() / f"{name}-{hashlib.sha256(key.encode()).hexdigest()[:16]}.json"
    try:
        return json.loads(path.read_bytes())
    except (OSError, ValueError):
        value = build()
    try:
        write_atomic(path, json.dumps(value, separators=(",", ":")))
        older = sorted(path.parent.glob(f"{name}-*.json"), key=lambda p: p.stat().st_mtime, reverse=True)
        for stale in older[KEPT:]:
            stale.unlink(missing_ok=True)
    except OSError:
        pass
    return value


@contextmanager
def held(name: str, wait_s: float = 0.0) -> Iterator[bool]:
    """Hold a lock of the cache folder, which threads and processes hold one after the other.

    Args:
        name: the lock's file.
        wait_s: another holder is waited for so long, s.

    Yields:
        False while another holds it. True also where nothing can be locked: a lock saves double work, and is no more.
    """
    until = time.monotonic() + wait_s
    with ExitStack() as stack:
        mine: bool | None = None
        with suppress(OSError):  # no file there, or a file system without locks
            handle = stack.enter_context((cache_folder() / name).open("w"))
            while not (mine := try_lock.taken(handle.fileno())) and time.monotonic() < until:
                time.sleep(0.05)
        yield mine is not False
