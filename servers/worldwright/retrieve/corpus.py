"""The documents that are searched: found on disk, identified by package, version and path."""

import hashlib
import time
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache, lru_cache
from pathlib import Path

from .. import __version__
from ..simulator import installed
from . import (
    c_chunks,
    forum_chunks,
    introspect_chunks,
    markdown_chunks,
    python_chunks,
    rst_chunks,
    rule_chunks,
    sources,
    xml_chunks,
    yaml_chunks,
)
from .chunk import Chunk

PARTS = {
    "manual": "the simulator's manual",
    "changelog": "its changelog, entry by entry",
    "skills": "how-to texts: the simulator's and ours",
    "rules": "our lint rules, checks, expectations, predicates and relations",
    "api": "its C headers and its own description of its functions, structs and enums",
    "python": "its Python modules, and the runtime that programs import",
    "examples": "accepted worlds: plans and programs",
    "catalog": "assets",
    "sources": "what the user added: a checkout, other repositories, forum history",
}
LEFT_OUT = {
    "XMLschema.rst": "a table of names without words; `symbol` answers from it",
    "XMLunits.rst": "a table of units without words; the attributes' own entries say them",
    "functions_override.rst": "the same text stands in functions.rst",
    "mjxmacro.h": "lists of names for the preprocessor; the structs have them with words",
    "mjspecmacro.h": "lists of names for the preprocessor; the structs have them with words",
}
SHELVES = (
    "lint/rules",
    "scan/anomalies/checks",
    "scan/objectives/expectations",
    "place/predicates",
    "place/relations",
    "scan/audits",
)
"""What authors of plans and programs read. A choice among folders, not a list of entries: those come from the folders."""
INTROSPECT = ("functions.py", "structs.py", "enums.py")
RUNTIME_LEFT_OUT = frozenset({"_catalog"})


@dataclass(frozen=True)
class Document:
    """One file of the corpus."""

    root: str
    """Package and version, e.g. `mujoco-4.0.0`."""
    path: str
    """Relative to the package, e.g. `doc/XMLreference.rst`."""
    file: Path
    part: str
    """One of `PARTS`."""

    @property
    def key(self) -> str:
        """How citations name it."""
        return f"{self.root}/{self.path}"

    def read(self) -> str:
        """Its text."""
        return self.file.read_text(encoding="utf-8", errors="replace")

    def chunks(self) -> Iterator[Chunk]:
        """Its pieces, cut along the structure of its kind."""
        text, name = self.read(), self.path.removesuffix(self.file.suffix).replace("/", ".")
        match self.file.suffix:
            case ".rst":
                yield from rst_chunks.chunks(text, entries=self.part == "changelog")
            case ".md":
                yield from markdown_chunks.chunks(text)
            case ".py" if self.part == "rules":
                yield from rule_chunks.chunks(text, self.file.stem)
            case ".py" if self.path.startswith("introspect/"):
                yield from introspect_chunks.chunks(text, self.file.stem)
            case ".py":
                yield from python_chunks.chunks(text, name, source=self.part in ("examples", "sources"))
            case ".yaml":
                yield from yaml_chunks.chunks(text)
            case ".jsonl":
                yield from forum_chunks.chunks(text)
            case ".xml":
                yield from xml_chunks.chunks(text, self.file.stem)
            case _:
                yield from c_chunks.chunks(text)


FRESH_S = 2.0
"""Seconds for which the list of our own texts and their content are not read again: questions come in bursts."""


def documents() -> list[Document]:
    """Every document there is, in a fixed order."""
    return [*_installed(), *_lately(int(time.monotonic() / FRESH_S)), *_users()]


@cache
def _installed() -> tuple[Document, ...]:
    """The simulator's documents: a running process has one installation."""
    return tuple(_simulator())


@lru_cache(maxsize=1)
def _lately(_moment: int) -> tuple[Document, ...]:
    """Our own documents as they were at a moment."""
    return tuple(_ours())


def _simulator() -> Iterator[Document]:
    root = f"mujoco-{installed.version()}"
    folder = installed.manual_folder()
    for file in sorted((*folder.rglob("*.rst"), *folder.rglob("*.md"))):
        path = file.relative_to(folder)
        if file.name in LEFT_OUT or path.parts[0] == "includes":
            continue
        part = "changelog" if file.name == "changelog.rst" else "skills" if "skills" in path.parts else "manual"
        yield Document(root, f"doc/{path.as_posix()}", file, part)
    package = installed.package_folder()
    for file in sorted((package / "include").rglob("*.h")):
        if file.name not in LEFT_OUT:
            yield Document(root, file.relative_to(package).as_posix(), file, "api")
    for name in INTROSPECT:
        if (file := package / "introspect" / name).is_file():
            yield Document(root, f"introspect/{name}", file, "api")
    for file in sorted(package.rglob("*.py")):
        path = file.relative_to(package)
        if (
            path.parts[0] not in ("introspect", "testdata")
            and not file.stem.endswith("_test")
            and "tests" not in path.parts
        ):
            yield Document(root, path.as_posix(), file, "python")


def _ours() -> Iterator[Document]:
    root = f"worldwright-{__version__}"
    package = Path(__file__).parents[1]
    for shelf in SHELVES:
        for file in sorted((package / shelf).rglob("*.py")):
            if not file.name.startswith("_"):
                yield Document(root, file.relative_to(package).as_posix(), file, "rules")
    runtime = package.parent / "worldkit"
    for file in sorted(runtime.rglob("*.py")):
        if not RUNTIME_LEFT_OUT.intersection(file.parts):
            yield Document(root, f"worldkit/{file.relative_to(runtime).as_posix()}", file, "python")
    checkout = package.parents[1]  # skills/, examples/ and catalog/ stand beside servers/ in a checkout
    for folder, pattern, part in (
        ("skills", "*/SKILL.md", "skills"),
        ("skills", "*/references/*.md", "skills"),
        ("skills", "*/references/*/plan.md", "examples"),
        ("examples", "*/plan.md", "examples"),
        ("examples", "*/simulation.py", "examples"),
        ("catalog", "*/asset.yaml", "catalog"),
    ):
        for file in sorted((checkout / folder).glob(pattern)):
            yield Document(root, file.relative_to(checkout).as_posix(), file, part)


def _users() -> Iterator[Document]:
    for top in sources.roots():
        for file in sources.files(top):
            path = file.name if top.is_file() else file.relative_to(top).as_posix()
            yield Document(sources.name(top), path, file, "sources")


def fingerprint() -> str:
    """SHA-256 over every document's name and content (of the user's own files: their times and sizes)."""
    total = hashlib.sha256(_fixed(int(time.monotonic() / FRESH_S)).encode())
    for document in _users():
        stat = document.file.stat()
        total.update(f"{document.key}\0{document.file}:{stat.st_mtime_ns}:{stat.st_size}\n".encode())
    return total.hexdigest()


@lru_cache(maxsize=1)
def _fixed(moment: int) -> str:
    """The same over the simulator's documents and ours, as they were at a moment."""
    total = hashlib.sha256()
    for document in (*_installed(), *_lately(moment)):
        stat = document.file.stat()
        digest = _digest(document.file, stat.st_mtime_ns, stat.st_size)
        total.update(f"{document.key}\0{document.part}\0{digest}\n".encode())
    return total.hexdigest()


@cache
def _digest(file: Path, _modified_ns: int, _size: int) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
