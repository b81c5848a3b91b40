"""Keep tables and indexes, which are made from the installed packages, between runs."""

import hashlib
import json
import os
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

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
