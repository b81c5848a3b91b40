"""Files that belong to a program: the modules beside it that it imports, and the data beside it that it names.

They are part of what evidence is about, and of what a confined program may read. Found by reading, never by running: imports
of modules that lie in the run folder, and texts in the code that are the relative path of a file or a folder there. What a
program reaches by a name put together while it runs is not found, and then is not there in the sandbox either: name it.
"""

import ast
import hashlib
from collections.abc import Iterator, Mapping
from functools import lru_cache
from pathlib import Path

from . import syntax
from .errors import WorldwrightError

OURS = (
    "plan.md", "prompt.md", "model.json", "simulation.py", "film.py", "journal.jsonl", "blocked.json", "report.html", "stamp.json",
    "environment.lock", "accepted", "earlier", "evidence", "jobs", "rehearsal", "proof", "source", "out", "runs", "examples",
    "handed_in.mp4", "handed_in.webm", "handed_in.mov",
)  # fmt: skip
"""Files of a run folder that belong to no program."""
MOST_FILES = 2_000
MOST_BYTES = 256 << 20


class CompanionError(WorldwrightError):
    """The files beside a program are more, or larger, than evidence keeps."""

    code = "companions"


class _Disk:
    """The files of a folder that are reached through no link."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def has(self, path: Path) -> bool:
        try:
            return path.is_file() and path.resolve() == self.folder.resolve() / path.relative_to(self.folder)
        except (OSError, ValueError):
            return False

    def read(self, path: Path) -> bytes:
        return path.read_bytes()

    def below(self, path: Path) -> list[Path]:
        return sorted(filter(self.has, path.rglob("*"))) if path.is_dir() and not path.is_symlink() else []


class _Memory:
    """Files by their relative paths, below the folder `.`."""

    def __init__(self, files: Mapping[str, bytes]) -> None:
        self.folder, self._files = Path(), files

    def has(self, path: Path) -> bool:
        return path.as_posix() in self._files

    def read(self, path: Path) -> bytes:
        return self._files[path.as_posix()]

    def below(self, path: Path) -> list[Path]:
        return sorted(Path(name) for name in self._files if name.startswith(f"{path.as_posix()}/"))


def of(program: Path, folder: Path | None = None) -> dict[str, bytes]:
    """Content by path relative to the program's folder, in the order of the names.

    Args:
        program: a file of Python.
        folder: of the run, where the file lies deeper in it.

    Raises:
        CompanionError: there are more than 2000 files, or more than 256 MB.
    """
    return _found(program, _Disk(folder or program.parent))


def among(files: Mapping[str, bytes], name: str) -> dict[str, bytes]:
    """`of` for one of some files that are read already, by path relative to the run folder."""
    return _found(Path(name), _Memory(files))


def _found(program: Path, tree: _Disk | _Memory) -> dict[str, bytes]:
    found: dict[str, bytes] = {}
    queue, size = [program], 0
    while queue:
        for path in _named(queue.pop(), tree):
            name = path.relative_to(tree.folder).as_posix()
            if name in found or path == program:
                continue
            found[name] = tree.read(path)
            size += len(found[name])
            if path.suffix == ".py":
                queue.append(path)
            if len(found) > MOST_FILES or size > MOST_BYTES:
                raise CompanionError(
                    f"the files beside the program are more than {MOST_FILES}, or {MOST_BYTES >> 20} MB",
                    place=str(tree.folder),
                    next_move="keep beside it what the world is made of, and nothing else",
                )
    return dict(sorted(found.items()))


def sha256(program: Path) -> str:
    """One hash over names and contents; empty when the program stands alone."""
    return digest_of(of(program)) if program.is_file() else ""


def digest_of(found: Mapping[str, bytes]) -> str:
    """The same over files that are read already, by path and in the order of the names."""
    digest = hashlib.sha256()
    for name, content in found.items():
        digest.update(f"{name}\n{hashlib.sha256(content).hexdigest()}\n".encode())
    return digest.hexdigest() if found else ""


def _named(source: Path, tree: _Disk | _Memory) -> Iterator[Path]:
    """Files that one module imports or names."""
    try:
        mentioned = _mentioned(tree.read(source))
    except (OSError, ValueError, SyntaxError, RecursionError):
        return
    for name, imported in mentioned:
        if imported:
            yield from _module(name, source.parent, tree)
        else:
            for base in dict.fromkeys((tree.folder, source.parent)):
                yield from _data(name, base, tree)


@lru_cache(maxsize=64)
def _mentioned(content: bytes) -> tuple[tuple[str, bool], ...]:
    """The names that a module imports (True) and the texts in it that may name a file (False), each once; remembered, since each
    step of a run asks for it. Raises what the parser raises."""
    found: list[tuple[str, bool]] = []
    for node in ast.walk(syntax.module(content)):
        if isinstance(node, ast.Import):
            found += [(alias.name, True) for alias in node.names]
        elif isinstance(node, ast.ImportFrom):
            module = node.module or ""
            found += [(name, True) for name in (module, *(f"{module}.{alias.name}".strip(".") for alias in node.names))]
        elif isinstance(node, ast.Constant) and isinstance(node.value, str) and _may_name(node.value):
            found.append((node.value, False))
    return tuple(dict.fromkeys(found))


def _may_name(text: str) -> bool:
    """Whether a text may be the relative path of a file."""
    return (
        bool(text)
        and len(text) <= 200
        and "\n" not in text
        and "\0" not in text
        and not text.startswith(("/", ".", "~"))
    )


def _module(name: str, base: Path, tree: _Disk | _Memory) -> Iterator[Path]:
    """The files of a module that lies in the folder: its own, and its packages' on the way."""
    if not name:
        return
    for root in dict.fromkeys((base, tree.folder)):
        path = root
        for part in name.split("."):
            path = path / part
            for candidate in (path.with_suffix(".py"), path / "__init__.py"):
                if tree.has(candidate) and candidate.name not in OURS:
                    yield candidate


def _data(text: str, base: Path, tree: _Disk | _Memory) -> Iterator[Path]:
    """The file that a text names, seen from one folder of the run, or all below the folder that it names."""
    path = base / text
    if (base == tree.folder and Path(text).parts[0] in OURS) or ".." in Path(text).parts:
        return
    if tree.has(path):
        yield path
    else:
        yield from (p for p in tree.below(path) if "__pycache__" not in p.parts)
