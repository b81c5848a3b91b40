"""Which files lie below a folder, asked by nearly every call of a tool: a folder is listed anew only once something came to it or went."""

import fnmatch
import os
import time
from dataclasses import dataclass, field

SETTLED_NS = 100_000_000
"""A folder that changed less long ago may change again within the same tick of its clock, so it is listed anew."""
MOST = 20_000
"""So many folders are remembered at most."""


@dataclass(frozen=True)
class _Listed:
    """What lay in a folder when it had last changed."""

    changed: int
    files: tuple[str, ...]
    links: frozenset[str]
    """Those of the files' paths that are links: what one leads to comes and goes without its folder."""
    folders: tuple[str, ...]
    fitting: dict[tuple[str, ...], tuple[str, ...]] = field(default_factory=dict)
    """The files' paths by patterns that were asked for."""


_seen: dict[str, _Listed] = {}


def files(root: str, patterns: tuple[str, ...] = ("*",), *, deep: bool = True) -> list[str]:
    """The paths of all files below a folder whose names match one of the patterns, in no order; no compiled code.

    Args:
        root: the folder; where there is none, there are no files.
        patterns: as `fnmatch` has them, of names.
        deep: also of the folders in it, unless they are links.
    """
    found: list[str] = []
    left = [root]
    while left:
        listed = _list(left.pop())
        if listed is None:
            continue
        fitting = listed.fitting.get(patterns)
        if fitting is None:
            names = [(path, os.path.basename(path)) for path in listed.files]  # noqa: PTH119 - of thousands
            fitting = tuple(path for path, name in names if any(fnmatch.fnmatch(name, one) for one in patterns))
            listed.fitting[patterns] = fitting
        found += fitting if not listed.links else (p for p in fitting if p not in listed.links or os.path.isfile(p))  # noqa: PTH113
        if deep:
            left += listed.folders
    return found


def _list(folder: str) -> _Listed | None:
    try:
        changed = os.stat(folder).st_mtime_ns  # noqa: PTH116
        held = _seen.get(folder)
        if held is not None and held.changed == changed:
            return held
        with os.scandir(folder) as entries:
            files, links, folders = [], set(), []
            for entry in entries:
                if entry.is_symlink():
                    files.append(entry.path)
                    links.add(entry.path)
                elif entry.is_file():
                    files.append(entry.path)
                elif entry.is_dir() and entry.name != "__pycache__":
                    folders.append(entry.path)
    except OSError:
        return None
    listed = _Listed(changed, tuple(files), frozenset(links), tuple(folders))
    if time.time_ns() - changed > SETTLED_NS:
        if len(_seen) >= MOST:
            _seen.clear()
        _seen[folder] = listed
    return listed
