"""One hash over many files, remembered as long as no file's size or time changes, so that asking costs milliseconds."""

import contextlib
import hashlib
import json
import os
import sys
from collections.abc import Iterable
from pathlib import Path

from worldkit import listings
from worldkit.files import write_json

Named = tuple[tuple[str | Path, str], ...]
"""Files, each with the name that counts for it."""


def cache_folder() -> Path:
    """Where this machine keeps what can always be made again: `WORLDWRIGHT_CACHE`, else the user's cache folder."""
    override = os.environ.get("WORLDWRIGHT_CACHE")
    if override:
        return Path(override)
    return Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "worldwright"


def below(root: Path, patterns: Iterable[str] = ("*",)) -> Named:
    """Matching files below a folder with their relative names, in a fixed order; thumbnails decide nothing."""
    # Plain texts: nearly every call of a tool asks this of some hundred files.
    start = str(root)
    found = (path for path in listings.files(start, tuple(patterns)) if not path.endswith(f"{os.sep}thumbnail.png"))
    plain = sorted(found, key=lambda path: path.replace(os.sep, "\0"))
    return tuple((path, path[len(start) + 1 :].replace(os.sep, "/")) for path in plain)


def sha256_of(name: str, files: Named) -> str:
    """SHA-256 over names and contents, kept in the cache under `name`."""
    paths = [os.fspath(path) for path, _ in files]
    stats = [(path, stat.st_size, stat.st_mtime_ns) for path, stat in zip(paths, map(os.stat, paths), strict=True)]
    stamp = hashlib.sha256(json.dumps([sys.version, stats]).encode()).hexdigest()
    kept = cache_folder() / f"hash-{name}.json"
    try:
        known = json.loads(kept.read_text(encoding="utf-8"))
        if known["stamp"] == stamp:
            return str(known["sha256"])
    except (OSError, ValueError, KeyError, TypeError):
        pass
    digest = hashlib.sha256()
    for path, relative in files:
        digest.update(relative.encode() + b"\0" + hashlib.sha256(Path(path).read_bytes()).digest())
    with contextlib.suppress(OSError):  # a read-only home costs time, not correctness
        write_json(kept, {"stamp": stamp, "sha256": digest.hexdigest()})
    return digest.hexdigest()
