"""What an author's code reads and writes: names, modules, files; and what is an author's own."""

import dis
import importlib.util
import sys
import sysconfig
from collections.abc import Iterable
from functools import cache
from pathlib import Path
from types import CodeType
from typing import NamedTuple

READERS = frozenset({
    "open", "fdopen", "fromfile", "genfromtxt", "load", "loadtxt", "memmap", "imread", "imopen", "urlopen", "File", "input",
    "environ", "getenv", "exists", "is_file", "is_dir", "stat", "glob", "rglob", "iterdir", "listdir", "scandir",
    "exec", "eval", "__import__", "import_module", "run_path", "run_module", "system", "popen", "Popen", "check_output",
})  # fmt: skip
READERS_BEGIN = ("read_", "open_", "load_", "imread_", "from_file")
"""What reads a file or the machine, or runs code that may, by the name of the function; a name that begins so does, too."""


class Reads(NamedTuple):
    """What a function and those in it read, and what they write."""

    names: frozenset[str]
    """Of its module."""
    imports: frozenset[str]
    """Modules, when it is called; a relative one begins with a dot."""
    attributes: frozenset[str]
    """Of whatever it has, read or written."""
    writes: frozenset[str]
    """Names that outlive the call: of its module, of a function around it, or attributes of what it was not given."""


def reads_of(code: CodeType) -> Reads:
    """What the instructions of a function and of those in it read and write."""
    steps = [step for step in dis.get_instructions(code) if step.opname != "EXTENDED_ARG"]

    def told(*names: str) -> frozenset[str]:
        return frozenset(str(step.argval) for step in steps if step.opname in names)

    imports, writes = set(), {*told("STORE_GLOBAL", "DELETE_GLOBAL")}
    writes |= told("STORE_DEREF", "DELETE_DEREF") & {*code.co_freevars}
    for number, step in enumerate(steps):
        if step.opname == "IMPORT_NAME":  # which stands behind how many folders it goes up, and what is taken of it
            imports.add("." * int(steps[number - 2].argval or 0) + str(step.argval))
        if step.opname in ("STORE_ATTR", "DELETE_ATTR") and not _is_its_own(steps[number - 1], code):
            writes.add(str(step.argval))
    attributes = told("LOAD_ATTR", "LOAD_METHOD", "IMPORT_FROM", "STORE_ATTR", "DELETE_ATTR")
    found = [Reads(told("LOAD_GLOBAL", "LOAD_NAME"), frozenset(imports), attributes, frozenset(writes))]
    for constant in code.co_consts:
        if isinstance(constant, CodeType):
            inner = reads_of(constant)
            found.append(inner._replace(writes=inner.writes - {*code.co_cellvars}))
    return Reads(*(frozenset().union(*parts) for parts in zip(*found, strict=True)))


def _is_its_own(loaded: dis.Instruction, code: CodeType) -> bool:
    """Whether what is loaded was given to the function, or made in it."""
    return loaded.opname.startswith("LOAD_FAST") or (
        loaded.opname == "LOAD_DEREF" and loaded.argval in code.co_cellvars
    )


def reads_more(name: str) -> bool:
    """Whether what is called so reads a file or the machine, or runs code that may."""
    return name in READERS or name.startswith(READERS_BEGIN)


def imports_an_authors(name: str) -> bool:
    """Whether an import in an author's function brings an author's module; nothing is run to say so."""
    top = name.partition(".")[0]
    if not top:  # seen from where the function lies
        return True
    if top in sys.modules:
        return by_an_author(top)
    try:
        spec = importlib.util.find_spec(top)
    except (ImportError, ValueError):
        return False
    return spec is not None and _own(spec.origin if spec.has_location else None, spec.submodule_search_locations)


def by_an_author(name: str | None) -> bool:
    """Whether a module is an author's own: neither Python's, nor an installed one, nor of this package."""
    module = sys.modules.get(name or "")
    if module is None:  # a file that was run
        return True
    return name == "__main__" or _own(getattr(module, "__file__", None), getattr(module, "__path__", None))


def _own(file: str | None, folders: Iterable[str] | None) -> bool:
    """Whether a module's file, or one of its folders where it has no file, is neither Python's, nor installed, nor of this package."""
    paths = [file] if file is not None else list(folders or ())
    return any(not in_a_library(Path(path)) for path in paths)


@cache
def in_a_library(path: Path) -> bool:
    """Whether a file is Python's, installed, or of this package, through whatever links it is reached."""
    return any(form.is_relative_to(folder) for form in _forms(path) for folder in _libraries())


@cache
def _libraries() -> tuple[Path, ...]:
    paths = (sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib"))
    folders = (*(Path(path) for path in paths if path), Path(__file__).absolute().parents[1])
    return tuple(dict.fromkeys(form for folder in folders for form in _forms(folder)))


def _forms(path: Path) -> tuple[Path, Path]:
    """A path as it is called, and where it really lies."""
    return path.absolute(), path.resolve()
