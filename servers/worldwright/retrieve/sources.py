"""Folders and files of the user's that are searched too: a simulator checkout, other repositories, a forum export.

They are named in `WORLDWRIGHT_SOURCES` (separated like `PATH`) or kept by `worldwright index --add`.
"""

import json
import os
from collections.abc import Iterator
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import NotFoundError
from ..simulator.cache import cache_folder
from .chunk import slug

SUFFIXES = (".rst", ".md", ".py", ".h", ".hpp", ".c", ".cc", ".cpp", ".xml", ".jsonl")
SKIPPED = frozenset({"build", "node_modules", "third_party", "dist", "site-packages", "__pycache__", "testdata"})
MAX_BYTES = 1_000_000
"""Largest file that is read; larger ones are data, except forum exports."""
MAX_FILES = 20_000


def roots() -> list[Path]:
    """The sources that exist, those of the environment first."""
    named = [part for part in os.environ.get("WORLDWRIGHT_SOURCES", "").split(os.pathsep) if part.strip()]
    found = dict.fromkeys(Path(part).expanduser().resolve() for part in (*named, *_kept()))
    return [root for root in found if root.exists()]


def add(path: Path) -> None:
    """Keep a source for every later search.

    Raises:
        NotFoundError: nothing lies there.
    """
    root = path.expanduser().resolve()
    if not root.exists():
        raise NotFoundError(f"there is no '{path}'", place=str(path), next_move="name a folder, or a .jsonl export")
    _keep([*dict.fromkeys([*_kept(), str(root)])])


def remove(path: Path) -> None:
    """Forget a source.

    Raises:
        NotFoundError: it was not kept; the kept ones are listed.
    """
    kept, root = _kept(), str(path.expanduser().resolve())
    if root not in kept:
        known = ", ".join(kept) or "none"
        raise NotFoundError(f"'{path}' is not a kept source", place=str(path), next_move=f"kept sources: {known}")
    _keep([one for one in kept if one != root])


def name(root: Path) -> str:
    """How citations name a source: its folder's or file's own name."""
    return f"{slug(root.stem if root.is_file() else root.name)}-local"


def files(root: Path) -> Iterator[Path]:
    """Its readable files in a fixed order; hidden folders, builds and big data are passed over."""
    if root.is_file():
        yield root
        return
    count = 0
    for folder, inside, names in os.walk(root):
        inside[:] = sorted(d for d in inside if d not in SKIPPED and not d.startswith("."))
        for entry in sorted(names):
            file = Path(folder, entry)
            if file.suffix not in SUFFIXES or not file.is_file():
                continue
            if file.suffix != ".jsonl" and file.stat().st_size > MAX_BYTES:
                continue
            count += 1
            if count > MAX_FILES:
                return
            yield file


def _list() -> Path:
    return cache_folder() / "sources.json"


def _kept() -> list[str]:
    try:
        value = json.loads(_list().read_bytes())
    except (OSError, ValueError):
        return []
    return [str(one) for one in value] if isinstance(value, list) else []


def _keep(paths: list[str]) -> None:
    write_atomic(_list(), json.dumps(paths, indent=1))
