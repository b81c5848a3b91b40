"""Read a file about which nothing is known: size, encoding and nesting are checked before it is parsed."""

import ast
import warnings
from dataclasses import dataclass, field
from pathlib import Path

from ..model import syntax
from ..model.errors import NotFoundError
from .problem import Problem

MAX_BYTES = 512 * 1024
"""About ten thousand lines: no program a person reads is larger, and parsing stays under a second."""
MAX_MODEL_BYTES = 4 * MAX_BYTES
"""Model files are often written by other programs."""
MODEL_SUFFIXES = (".xml", ".mjcf", ".urdf")


@dataclass(frozen=True)
class Source:
    """A file as far as it could be read; `problem` says why not further."""

    path: str
    text: str = ""
    tree: ast.Module | None = None
    problem: Problem | None = None
    lines: tuple[str, ...] = field(default=(), repr=False)

    @property
    def is_mjcf(self) -> bool:
        """Whether the file is a bare model, not a program."""
        return self.path.lower().endswith(MODEL_SUFFIXES)


def read(path: Path | str) -> Source:
    """Read and parse a file; only a missing or unreadable file is an error, all else is a `Source` with a problem."""
    path = Path(path)
    try:
        if not path.is_file():
            raise FileNotFoundError(f"there is no file '{path}'")
        size = path.stat().st_size
        limit = MAX_MODEL_BYTES if path.suffix.lower() in MODEL_SUFFIXES else MAX_BYTES
        if size > limit:
            text = f"the file has {size:,} bytes; the limit is {limit:,}"
            return Source(str(path), problem=Problem(text, "move data into files of its own: meshes, the catalog", 1))
        data = path.read_bytes()
    except OSError as cause:
        raise NotFoundError(
            f"the program cannot be read: {cause}", place=str(path), next_move="name an existing file"
        ) from cause
    return decode(data, str(path))


def decode(data: bytes, path: str = "simulation.py") -> Source:
    """Decode and parse bytes."""
    if b"\0" in data:
        return Source(path, problem=Problem("the file is binary (it contains NUL bytes)", "give Python source text", 1))
    try:
        text = data.decode("utf-8-sig")
    except UnicodeDecodeError as cause:
        line = data.count(b"\n", 0, cause.start) + 1
        reason = f"the file is not UTF-8: byte 0x{data[cause.start]:02x} at offset {cause.start}"
        return Source(path, problem=Problem(reason, "save it as UTF-8", line))
    return parse(text, path)


def parse(text: str, path: str = "simulation.py") -> Source:
    """Parse program text."""
    lines = tuple(text.splitlines())
    if not text.strip():
        return Source(path, text, None, Problem("the file is empty", "draft a program: worldwright go RUN", 1))
    if path.lower().endswith(MODEL_SUFFIXES):
        return Source(path, text, None, None, lines)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # e.g. invalid escapes: not about the simulation
            tree = syntax.module(text, path)
    except SyntaxError as cause:
        problem = Problem(f"not valid Python: {cause.msg}", "correct the syntax", cause.lineno or 1, cause.offset)
        return Source(path, text, None, problem, lines)
    except (RecursionError, MemoryError, ValueError) as cause:
        what = (
            "is nested too deeply to be parsed" if not isinstance(cause, ValueError) else f"cannot be parsed: {cause}"
        )
        return Source(path, text, None, Problem(f"the program {what}", "split it into statements", 1), lines)
    return Source(path, text, tree, None, lines)
