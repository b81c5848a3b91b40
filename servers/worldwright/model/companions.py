"""Files that belong to a program: the modules beside it that it imports, and the data beside it that it names.

They are part of what evidence is about, and of what a confined program may read. Found by reading, never by running: imports
of modules that lie in the run folder, and texts in the code that are the relative path of a file or a folder there. What a
program reaches by a name put together while it runs is not found, and then is not there in the sandbox either: name it.
"""

import ast
import hashlib
from collections.abc import Iterator
from pathlib import Path

from .errors import WorldwrightError

OURS = (
    "plan.md", "prompt.md", "model.json", "simulation.py", "film.py", "journal.jsonl", "blocked.json", "report.html", "stamp.json",
    "environment.lock", "accepted", "evidence", "jobs", "proof", "source", "out", "runs", "examples",
)  # fmt: skip
"""Files of a run folder that belong to no program."""
MOST_FILES = 2_000
MOST_BYTES = 256 << 20


class CompanionError(WorldwrightError):
    """The files beside a program are more, or larger, than evidence keeps."""

    code = "companions"


def of(program: Path, folder: Path | None = None) -> dict[str, bytes]:
    """Content by path relative to the program's folder, in the order of the names.

    Args:
        program: a file of Python.
        folder: of the run, where the file lies deeper in it.

    Raises:
        CompanionError: there are more than 2000 files, or more than 256 MB.
    """
    folder = folder or program.parent
    found: dict[str, bytes] = {}
    queue, size = [program], 0
    while queue:
        for path in _named(queue.pop(), folder):
            name = path.relative_to(folder).as_posix()
            if name in found or path == program:
                continue
            found[name] = path.read_bytes()
            size += len(found[name])
            if path.suffix == ".py":
                queue.append(path)
            if len(found) > MOST_FILES or size > MOST_BYTES:
                raise CompanionError(
                    f"the files beside the program are more than {MOST_FILES}, or {MOST_BYTES >> 20} MB",
                    place=str(folder),
                    next_move="keep beside it what the world is made of, and nothing else",
                )
    return dict(sorted(found.items()))


def sha256(program: Path) -> str:
    """One hash over names and contents; empty when the program stands alone."""
    found = of(program) if program.is_file() else {}
    digest = hashlib.sha256()
    for name, content in found.items():
        digest.update(f"{name}\n{hashlib.sha256(content).hexdigest()}\n".encode())
    return digest.hexdigest() if found else ""


def _named(source: Path, folder: Path) -> Iterator[Path]:
    """Files that one module imports or names."""
    try:
        tree = ast.parse(source.read_bytes())
    except (OSError, ValueError, SyntaxError, RecursionError):
        return
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            for alias in node.names:
                yield from _module(alias.name, source.parent, folder)
        elif isinstance(node, ast.ImportFrom):
            for name in (node.module or "", *(f"{node.module or ''}.{alias.name}".strip(".") for alias in node.names)):
                yield from _module(name, source.parent, folder)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            for base in dict.fromkeys((folder, source.parent)):
                yield from _data(node.value, base, folder)


def _module(name: str, base: Path, folder: Path) -> Iterator[Path]:
    """The files of a module that lies in the folder: its own, and its packages' on the way."""
    if not name:
        return
    for root in dict.fromkeys((base, folder)):
        path = root
        for part in name.split("."):
            path = path / part
            for candidate in (path.with_suffix(".py"), path / "__init__.py"):
                if _plain(candidate, folder) and candidate.name not in OURS:
                    yield candidate


def _data(text: str, base: Path, folder: Path) -> Iterator[Path]:
    """The file that a text names, seen from one folder of the run, or all below the folder that it names."""
    if not text or len(text) > 200 or "\n" in text or "\0" in text or text.startswith(("/", ".", "~")):
        return
    path = base / text
    if (base == folder and Path(text).parts[0] in OURS) or ".." in Path(text).parts:
        return
    if _plain(path, folder):
        yield path
    elif path.is_dir() and not path.is_symlink():
        yield from (p for p in sorted(path.rglob("*")) if _plain(p, folder) and "__pycache__" not in p.parts)


def _plain(path: Path, folder: Path) -> bool:
    """A file of the folder, reached through no link."""
    try:
        return path.is_file() and path.resolve() == folder.resolve() / path.relative_to(folder)
    except (OSError, ValueError):
        return False
