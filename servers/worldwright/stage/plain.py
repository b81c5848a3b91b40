"""Open the files that a confined program left only if they are plain files, without following links.

A link called `log.txt` may lead to a file of the host, which a careless write would overwrite, and a careless read would
publish. Whatever is taken out of a program's folder is taken by these functions.
"""

import os
import stat
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model import json_object

MB = 1 << 20
MOST_JSON = json_object.MOST_BYTES
"""Bytes of a report."""


def read(path: Path, limit: int) -> bytes | None:
    """The content of a plain file of at most `limit` bytes; None for anything else.

    A file with a second name may be somebody else's, so it is no plain file here.
    """
    try:
        handle = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
    except OSError:
        return None
    with os.fdopen(handle, "rb") as stream:
        facts = os.fstat(handle)
        good = stat.S_ISREG(facts.st_mode) and facts.st_nlink == 1 and facts.st_size <= limit
        content = stream.read(limit + 1) if good else b""
    return content if good and len(content) <= limit else None


def read_json(path: Path) -> dict[str, Any]:
    """A JSON object, or an empty one: what a confined program writes is never trusted."""
    return as_object(read(path, MOST_JSON) or b"")


def as_object(content: bytes) -> dict[str, Any]:
    """The JSON object that a content is, or an empty one; what is larger than `MOST_JSON` is not parsed."""
    return json_object.told(content) or {}


def take(path: Path, to: Path, limit: int) -> bool:
    """Copy a plain file; returns False when it is none, or too large."""
    content = read(path, limit)
    if content is None:
        return False
    write_atomic(to, content)
    return True


def odd(folder: Path) -> Iterator[str]:
    """Names below a folder that are neither folders nor plain files with one name; nobody may write there meanwhile."""
    for entry in sorted(os.scandir(folder), key=lambda entry: entry.name):
        facts = entry.stat(follow_symlinks=False)
        if stat.S_ISDIR(facts.st_mode):
            yield from (f"{entry.name}/{name}" for name in odd(Path(entry.path)))
        elif not stat.S_ISREG(facts.st_mode) or facts.st_nlink != 1:
            yield entry.name
