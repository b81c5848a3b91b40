"""The documents that are searched: found on disk, identified by package, version and path."""

import hashlib
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from .. import __version__
from ..simulator import installed
from . import markdown_chunks, rst_chunks, rule_chunks
from .chunk import Chunk

LEFT_OUT = {
    "XMLschema.rst": "a table of names without words; `symbol` answers from it",
    "XMLunits.rst": "a table of units without words; the attributes' own entries say them",
    "functions_override.rst": "the same text stands in functions.rst",
}
SHELVES = ("lint/rules", "scan/checks", "scan/expectations", "place/predicates", "place/relations")


@dataclass(frozen=True)
class Document:
    """One file of the corpus."""

    root: str
    """Package and version, e.g. `mujoco-4.0.0`."""
    path: str
    """Relative to the package, e.g. `doc/XMLreference.rst`."""
    file: Path
    part: str
    """`manual`, `changelog`, `skills` or `rules`."""

    @property
    def key(self) -> str:
        """How citations name it."""
        return f"{self.root}/{self.path}"

    def read(self) -> str:
        """Its text."""
        return self.file.read_text(encoding="utf-8", errors="replace")

    def chunks(self) -> Iterator[Chunk]:
        """Its pieces."""
        text = self.read()
        if self.file.suffix == ".rst":
            yield from rst_chunks.chunks(text, entries=self.part == "changelog")
        elif self.file.suffix == ".md":
            yield from markdown_chunks.chunks(text)
        else:
            yield from rule_chunks.chunks(text, self.file.stem)


def documents() -> list[Document]:
    """Every document there is, in a fixed order."""
    return [*_manual(), *_ours()]


def _manual() -> Iterator[Document]:
    root = f"mujoco-{installed.version()}"
    folder = installed.manual_folder()
    for file in sorted((*folder.rglob("*.rst"), *folder.rglob("*.md"))):
        path = file.relative_to(folder)
        if file.name in LEFT_OUT or path.parts[0] == "includes":
            continue
        part = "changelog" if file.name == "changelog.rst" else "skills" if "skills" in path.parts else "manual"
        yield Document(root, f"doc/{path.as_posix()}", file, part)


def _ours() -> Iterator[Document]:
    root = f"worldwright-{__version__}"
    package = Path(__file__).parents[1]
    for shelf in SHELVES:
        for file in sorted((package / shelf).rglob("*.py")):
            if not file.name.startswith("_"):
                yield Document(root, file.relative_to(package).as_posix(), file, "rules")
    skills = package.parents[1] / "skills"  # beside servers/ in a checkout
    for file in sorted(skills.rglob("*.md")) if skills.is_dir() else ():
        yield Document(root, "skills/" + file.relative_to(skills).as_posix(), file, "skills")


def fingerprint(found: list[Document]) -> str:
    """SHA-256 over every document's name and content."""
    total = hashlib.sha256()
    for document in found:
        stat = document.file.stat()
        digest = _digest(document.file, stat.st_mtime_ns, stat.st_size)
        total.update(f"{document.key}\0{document.part}\0{digest}\n".encode())
    return total.hexdigest()


@cache
def _digest(file: Path, modified_ns: int, size: int) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()
