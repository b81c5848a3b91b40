"""A short text for what something is made of: equal texts, equal things. What is kept of earlier runs is found by it."""

import dis
import hashlib
import random
import sys
import sysconfig
from functools import cache, cached_property
from pathlib import Path, PurePath
from types import CodeType, FunctionType, GetSetDescriptorType, MemberDescriptorType, ModuleType
from typing import Any

import numpy as np

PLAIN = (type(None), bool, int, float, complex, bytes, type(Ellipsis), range, np.dtype)
LONGEST_PATH = 400
COMMON = (np.random.rand.__self__, random.random.__self__)  # type: ignore[attr-defined]
"""The generators of all, which are seeded anew for each shape: where they stand now is nothing that a shape is made of."""


class _UnknownError(Exception):
    """Nobody can tell what a thing is made of."""


def signature(*things: Any) -> str:
    """Differs when the things differ: numbers, texts, arrays, shapes, functions with all that they read, objects with their state.

    Empty where one of them is unknown: it cannot be taken apart, or is a shape without a signature. A path below a folder of
    Python's path is told by its place there and its file's content, wherever that folder lies.
    """
    digest, seen = hashlib.sha256(), dict[int, tuple[int, Any]]()
    try:
        for thing in things:
            digest.update(_told(thing, seen) + b"\0")
    except (_UnknownError, RecursionError):
        return ""
    return digest.hexdigest()[:24]


def _told(thing: Any, seen: dict[int, tuple[int, Any]]) -> bytes:
    if isinstance(thing, PLAIN):
        return f"{type(thing).__name__}:{thing!r}".encode()
    if isinstance(thing, str | PurePath):
        return _text_or_path(str(thing))
    if type(thing) is np.ndarray and not thing.dtype.hasobject:
        return f"{thing.dtype}{thing.shape}".encode() + np.ascontiguousarray(thing).tobytes()
    if type(thing).__module__.startswith(__package__) and isinstance(getattr(thing, "recipe", None), str):
        if not thing.recipe:
            raise _UnknownError
        return str(thing.recipe).encode()
    if isinstance(thing, tuple):
        return b"[" + b",".join(_told(one, seen) for one in thing) + b"]"
    if isinstance(thing, frozenset):
        return b"{" + b",".join(sorted(_told(one, seen) for one in thing)) + b"}"
    if isinstance(thing, CodeType):
        return thing.co_code + repr(thing.co_names).encode() + _told(thing.co_consts, seen)
    if id(thing) in seen:
        return f"again {seen[id(thing)][0]}".encode()
    seen[id(thing)] = (len(seen), thing)  # held, so that nothing else gets its number
    if isinstance(thing, list | set):
        return _told(tuple(thing) if isinstance(thing, list) else frozenset(thing), seen)
    if isinstance(thing, dict):
        pairs = sorted(thing.items(), key=lambda pair: repr(pair[0]))
        return b"{" + b",".join(_told(pair, seen) for pair in pairs) + b"}"
    if isinstance(thing, FunctionType):
        return _function(thing, seen)
    if isinstance(thing, ModuleType):
        return _module(thing, seen)
    if isinstance(thing, type):
        return _class(thing, seen)
    return _object(thing, seen)


def _function(function: FunctionType, seen: dict[int, tuple[int, Any]]) -> bytes:
    """A function by its instructions, defaults, what it closes over, and what it reads of its module and those beside it."""
    given = (function.__defaults__, function.__kwdefaults__, function.__dict__)
    parts = [_told(one, seen) for one in given]
    for cell in function.__closure__ or ():
        try:
            parts.append(_told(cell.cell_contents, seen))
        except ValueError:  # not filled yet
            parts.append(b"empty")
    if not _by_an_author(function.__module__):
        return b"|".join([f"{function.__module__}.{function.__qualname__}".encode(), *parts])
    parts.append(_told(function.__code__, seen))
    here = Path(function.__code__.co_filename).absolute().parent
    for name in sorted(_names(function.__code__)):
        beside = here / f"{name.replace('.', '/')}.py"
        if name in function.__globals__:
            parts.append(name.encode() + _told(function.__globals__[name], seen))
        elif beside.is_file():  # imported when it is called
            parts.append(name.encode() + _content(beside))
    return b"|".join(parts)


def _class(kind: type, seen: dict[int, tuple[int, Any]]) -> bytes:
    """A class by its name; an author's own by what it says, and by those that it builds on."""
    parts = [f"{kind.__module__}.{kind.__qualname__}".encode()]
    if _by_an_author(kind.__module__):
        parts += [_told(base, seen) for base in kind.__bases__]
        for name, value in sorted(vars(kind).items()):
            inner = value.__func__ if isinstance(value, staticmethod | classmethod) else value
            inner = value.fget if isinstance(value, property) else inner
            inner = value.func if isinstance(value, cached_property) else inner
            slot = isinstance(value, GetSetDescriptorType | MemberDescriptorType) or name == "_abc_impl"
            if isinstance(inner, FunctionType) or not (name.startswith("__") or slot):
                parts.append(name.encode() + _told(inner, seen))
    return b"|".join(parts)


def _object(thing: Any, seen: dict[int, tuple[int, Any]]) -> bytes:
    """Anything else by its class and by what Python would copy it from."""
    if any(thing is one or getattr(thing, "__self__", None) is one for one in COMMON):
        return f"common {type(thing).__name__} {getattr(thing, '__name__', '')}".encode()
    try:
        told = thing.__reduce_ex__(4)
    except Exception as cause:  # what cannot be copied, for whatever reason, is unknown
        raise _UnknownError from cause
    kind = _told(type(thing), seen)
    if isinstance(told, str):
        return kind + f"{getattr(thing, '__module__', '')}.{told}".encode()
    made_by, arguments, *state = told
    rest = [list(one) if hasattr(one, "__next__") else one for one in state]
    return kind + b"|".join(_told(one, seen) for one in (made_by, arguments, rest))


def _module(module: ModuleType, seen: dict[int, tuple[int, Any]]) -> bytes:
    """A module by its name; an author's own by its text, and by the modules of an author that it reads."""
    parts = [module.__name__.encode()]
    if _by_an_author(module.__name__):
        parts.append(_content(Path(module.__file__ or "")))
        homes = {getattr(value, "__module__", None) for value in vars(module).values()}
        others = [value for value in vars(module).values() if isinstance(value, ModuleType)]
        others += [sys.modules[home] for home in sorted(h for h in homes if isinstance(h, str) and h in sys.modules)]
        parts += [_told(one, seen) for one in others if _by_an_author(one.__name__)]
    return b"|".join(parts)


def _names(code: CodeType) -> set[str]:
    """What a function and those in it read of their module, or import."""
    reads = ("LOAD_GLOBAL", "LOAD_NAME", "IMPORT_NAME")
    inner = (constant for constant in code.co_consts if isinstance(constant, CodeType))
    own = {step.argval for step in dis.get_instructions(code) if step.opname in reads}
    return own.union(*(_names(one) for one in inner))


def _text_or_path(text: str) -> bytes:
    """A text; of one that is a path below a folder of Python's path, its place there, and its content if it is a file."""
    if len(text) < LONGEST_PATH and Path(text).is_absolute() and "\0" not in text:
        path = Path(text)
        roots = [Path(folder) for folder in sys.path if len(folder) > 1 and path.is_relative_to(folder)]
        if roots:
            inner = path.relative_to(min(roots, key=lambda root: len(root.parts))).as_posix()
            return b"path:" + inner.encode() + (_content(path) if path.is_file() else b"")
    return b"str:" + text.encode("utf-8", "surrogatepass")


def _content(path: Path) -> bytes:
    try:
        return hashlib.sha256(path.read_bytes()).digest()
    except OSError as cause:
        raise _UnknownError from cause


@cache
def _libraries() -> tuple[str, ...]:
    paths = (sysconfig.get_path(name) for name in ("stdlib", "platstdlib", "purelib", "platlib"))
    return (*(path for path in paths if path), str(Path(__file__).absolute().parents[1]))


def _by_an_author(name: str | None) -> bool:
    """Whether a module is an author's own: neither Python's, nor an installed one, nor of this package."""
    module = sys.modules.get(name or "")
    if module is None:  # a file that was run
        return True
    file = getattr(module, "__file__", None)
    if file is None:
        return name == "__main__"
    return not any(Path(file).absolute().is_relative_to(folder) for folder in _libraries())
