"""The assets that a world uses, found by reading: what of the catalog its plan, its program or a file beside it names.

A world's evidence depends on them and on no others, so adding an asset leaves every run valid. What a program reaches by
a name put together while it runs is not found here; the build pass reports what it took, and a build that took something
that is not named is refused (`unnamed`).
"""

import hashlib
import re
from collections.abc import Iterable
from functools import lru_cache
from pathlib import Path

from .. import companions
from .file_hashes import below, sha256_of

OURS = ("make", "meshes", "__pycache__")
"""Folders of the catalog whose names are no assets' names."""


def named(source: Path, program: Path) -> tuple[str, ...]:
    """The assets, and what else of the catalog's top level, that are whole words of the plan or of the program.

    Args:
        source: `plan.md`, or `model.json`.
        program: `simulation.py`; the files beside it that belong to it count too.
    """
    known = _known()
    texts = [path.read_bytes() for path in (source, program) if path.is_file()]
    texts += companions.of(program).values() if program.is_file() else ()
    words = [_words(text) for text in texts]
    return tuple(name for name in known if any(name.encode() in found for found in words))


def sha256(source: Path, program: Path) -> str:
    """One hash over all files of the assets that are named; empty when there are none."""
    root, names = _root(), named(source, program)
    if root is None or not names:
        return ""
    from worldkit import assets

    digest = hashlib.sha256()
    for name in names:
        path = root / name
        own = tuple((file, assets.relative(file)) for file in assets.files(name))
        files = own or (below(path) if path.is_dir() else ((path, name),))
        digest.update(f"{name} {sha256_of(f'asset-{name}', files)}\n".encode())
    return digest.hexdigest()


def unnamed(taken: Iterable[str], source: Path, program: Path) -> tuple[str, ...]:
    """The names of what a build took from the catalog although no text names it."""
    found = set(taken)
    return tuple(sorted(found - set(named(source, program)))) if found else ()


@lru_cache(maxsize=64)
def _words(text: bytes) -> frozenset[bytes]:
    """The whole words of a text, and their parts between dots and dashes; remembered, since each step of a run asks for them."""
    words = set(re.findall(rb"[\w.-]*\w", text))
    return frozenset(words | {part for word in words for part in re.split(rb"[.-]", word)})


def _known() -> list[str]:
    root = _root()
    if root is None:
        return []
    from worldkit import assets

    return sorted({*assets.keys(), *(path.name for path in root.iterdir() if path.name not in OURS)})


def _root() -> Path | None:
    from worldkit.assets.root import catalog_root

    try:
        return catalog_root()
    except FileNotFoundError:
        return None
