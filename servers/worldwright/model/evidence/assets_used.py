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

    An asset of the user's own counts only where a `filename` of the plan or a quoted string of the program is its key, since a
    word such as "ball" would else make a world depend on what somebody took in for another.

    Args:
        source: `plan.md`, or `model.json`.
        program: `simulation.py`; the files beside it that belong to it count too.
    """
    known = _known()
    plan = source.read_bytes() if source.is_file() else b""
    texts = [program.read_bytes(), *companions.of(program).values()] if program.is_file() else []
    words = [_words(text) for text in (plan, *texts)]
    said = [_filenames(plan), *(_quoted(text) for text in texts)]
    return tuple(
        name for name, own in known.items() if any(name.encode() in found for found in (said if own else words))
    )


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


@lru_cache(maxsize=64)
def _filenames(text: bytes) -> frozenset[bytes]:
    """What a plan or a model says as a `filename`."""
    return frozenset(re.findall(rb"""\bfilename["']?\s*:\s*["']?([\w.-]*\w)""", text))


@lru_cache(maxsize=64)
def _quoted(text: bytes) -> frozenset[bytes]:
    """The words that stand alone in quotes."""
    return frozenset(re.findall(rb"""["'](\w+)(?=["'])""", text))


def _known() -> dict[str, bool]:
    """Every name, sorted, and whether it is the key of an asset of the user's own."""
    root = _root()
    if root is None:
        return {}
    from worldkit.assets import catalog

    found = {path.name: False for path in root.iterdir() if path.name not in OURS}
    found |= {key: source == catalog.OWN for key, source in catalog.sources().items()}
    return dict(sorted(found.items()))


def _root() -> Path | None:
    from worldkit.data_folders import catalog_root

    try:
        return catalog_root()
    except FileNotFoundError:
        return None
