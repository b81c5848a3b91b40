"""A short text for what something is made of: equal texts, equal things. What is kept of earlier runs is found by it."""

import hashlib
import random
import sys
from contextlib import suppress
from functools import cached_property
from pathlib import Path, PurePath
from types import (
    BuiltinFunctionType,
    CodeType,
    FunctionType,
    GetSetDescriptorType,
    MemberDescriptorType,
    MethodType,
    ModuleType,
)
from typing import Any

import numpy as np

from .authors import by_an_author, imports_an_authors, reads_more, reads_of

PLAIN = (type(None), bool, int, float, complex, bytes, type(Ellipsis), range, np.dtype)
GENERATORS = (np.random.Generator, np.random.RandomState, np.random.BitGenerator, random.Random)
"""What draws from one of these leaves it elsewhere, so that it cannot be spared: things drawn after it would be others."""
COMMON = (np.random.rand.__self__, random.random.__self__)  # type: ignore[attr-defined]
"""The generators of all, which are seeded anew for each shape: where they stand now is nothing that a shape is made of."""
CALLABLES = (FunctionType, BuiltinFunctionType, MethodType, type)
MOST_BYTES = 64 << 20
"""Of a file whose content counts; nobody looks through a larger one."""


class _UnknownError(Exception):
    """Nobody can tell what a thing is made of."""


class _Met:
    """Things met so far, so that one that comes again is told by its number, and the contents of files."""

    def __init__(self) -> None:
        self._numbers: dict[int, tuple[int, Any]] = {}
        self._contents: dict[Path, bytes] = {}

    def before(self, thing: Any) -> int | None:
        """The number of a thing that was met before; one that was not gets one."""
        if id(thing) in self._numbers:
            return self._numbers[id(thing)][0]
        self._numbers[id(thing)] = (len(self._numbers), thing)  # held, so that nothing else gets its number
        return None

    def content(self, path: Path) -> bytes:
        """A short text for what is in a file; that of one which is too large is unknown."""
        real = path.resolve()
        if real not in self._contents:
            try:
                if real.stat().st_size > MOST_BYTES:
                    raise _UnknownError
                self._contents[real] = hashlib.sha256(real.read_bytes()).digest()
            except OSError as cause:
                raise _UnknownError from cause
        return self._contents[real]


def signature(*things: Any) -> str:
    """Differs when the things differ: numbers, texts, arrays, shapes, functions with all that they read, objects with their state.

    Empty where one of them is unknown. That depends on nothing but what it is made of, so that it is unknown in every process:

    - it cannot be taken apart, holds a generator of random numbers, or is a shape without a signature;
    - a function of an author's in it reads a file or the machine when it is called (`authors.READERS`), imports an author's
      module then, or writes what outlives the call.

    A path below a folder of Python's path is told by its place there and its file's content, wherever that folder lies. Not
    told is what a library reads when it is called by a name that nobody would know for it.
    """
    digest, met = hashlib.sha256(), _Met()
    try:
        for thing in things:
            digest.update(_told(thing, met) + b"\0")
    except (_UnknownError, RecursionError):
        return ""
    return digest.hexdigest()[:24]


def _told(thing: Any, met: _Met) -> bytes:
    if isinstance(thing, PLAIN):
        return f"{type(thing).__name__}:{thing!r}".encode()
    if isinstance(thing, str | PurePath):
        return _text_or_path(str(thing), met)
    if type(thing) is np.ndarray and not thing.dtype.hasobject:
        return f"{thing.dtype}{thing.shape}".encode() + np.ascontiguousarray(thing).tobytes()
    if type(thing).__module__.startswith(__package__) and isinstance(getattr(thing, "recipe", None), str):
        if not thing.recipe:
            raise _UnknownError
        return str(thing.recipe).encode()
    if isinstance(thing, tuple):
        return b"[" + b",".join(_told(one, met) for one in thing) + b"]"
    if isinstance(thing, frozenset):
        return b"{" + b",".join(sorted(_told(one, met) for one in thing)) + b"}"
    if isinstance(thing, CodeType):
        return thing.co_code + repr(thing.co_names).encode() + _told(thing.co_consts, met)
    if isinstance(thing, CALLABLES) and reads_more(thing.__name__) and not by_an_author(thing.__module__):
        raise _UnknownError
    number = met.before(thing)
    if number is not None:
        return f"again {number}".encode()
    if isinstance(thing, list | set):
        return _told(tuple(thing) if isinstance(thing, list) else frozenset(thing), met)
    if isinstance(thing, dict):
        pairs = sorted(thing.items(), key=lambda pair: repr(pair[0]))
        return b"{" + b",".join(_told(pair, met) for pair in pairs) + b"}"
    if isinstance(thing, FunctionType):
        return _function(thing, met)
    if isinstance(thing, ModuleType):
        return _all_of(thing, met)
    if isinstance(thing, type):
        return _class(thing, met)
    return _object(thing, met)


def _function(function: FunctionType, met: _Met) -> bytes:
    """A function by its instructions, defaults, what it closes over, and what it reads of its module and those beside it."""
    given = (function.__defaults__, function.__kwdefaults__, function.__dict__)
    parts = [_told(one, met) for one in given]
    for cell in function.__closure__ or ():
        try:
            parts.append(_read(cell.cell_contents, met))
        except ValueError:  # not filled yet
            parts.append(b"empty")
    if not by_an_author(function.__module__):
        return b"|".join([f"{function.__module__}.{function.__qualname__}".encode(), *parts])
    reads = reads_of(function.__code__)
    elsewhere = reads.attributes | (reads.names - function.__globals__.keys())
    if reads.writes or any(map(reads_more, elsewhere)) or any(map(imports_an_authors, reads.imports)):
        raise _UnknownError
    parts.append(_told(function.__code__, met))
    known = [(name, function.__globals__[name]) for name in sorted(reads.names) if name in function.__globals__]
    parts += [name.encode() + _read(value, met) for name, value in known]
    held = [*_held_by(function), *(value for _, value in known)]
    parts += [name.encode() + _read(value, met) for name, value in _read_of_modules(held, reads.attributes)]
    return b"|".join(parts)


def _read(thing: Any, met: _Met) -> bytes:
    """What a function has; of a module what it reads is told beside it."""
    return _module(thing, met) if isinstance(thing, ModuleType) else _told(thing, met)


def _held_by(function: FunctionType) -> list[Any]:
    """The values of a function's defaults and of what it closes over."""
    held = [*(function.__defaults__ or ()), *(function.__kwdefaults__ or {}).values()]
    for cell in function.__closure__ or ():
        with suppress(ValueError):  # not filled yet
            held.append(cell.cell_contents)
    return held


def _read_of_modules(held: list[Any], attributes: frozenset[str]) -> list[tuple[str, Any]]:
    """What is read of an author's modules among some values: their text alone does not tell what stands in them now."""
    found: list[tuple[str, Any]] = []
    left, done = [one for one in held if isinstance(one, ModuleType)], set()
    while left:
        module = left.pop()
        if id(module) in done or not by_an_author(module.__name__):
            continue
        done.add(id(module))
        values = [(name, vars(module)[name]) for name in sorted(attributes) if name in vars(module)]
        left += [value for _, value in values if isinstance(value, ModuleType)]
        found += values
    return found


def _class(kind: type, met: _Met) -> bytes:
    """A class by its name; an author's own by what it says, and by those that it builds on."""
    parts = [f"{kind.__module__}.{kind.__qualname__}".encode()]
    if by_an_author(kind.__module__):
        parts += [_told(base, met) for base in kind.__bases__]
        for name, value in sorted(vars(kind).items()):
            inner = value.__func__ if isinstance(value, staticmethod | classmethod) else value
            inner = value.fget if isinstance(value, property) else inner
            inner = value.func if isinstance(value, cached_property) else inner
            slot = isinstance(value, GetSetDescriptorType | MemberDescriptorType) or name == "_abc_impl"
            if isinstance(inner, FunctionType) or not (name.startswith("__") or slot):
                parts.append(name.encode() + _told(inner, met))
    return b"|".join(parts)


def _object(thing: Any, met: _Met) -> bytes:
    """Anything else by its class and by what Python would copy it from."""
    if any(thing is one or getattr(thing, "__self__", None) is one for one in COMMON):
        return f"common {type(thing).__name__} {getattr(thing, '__name__', '')}".encode()
    if isinstance(thing, GENERATORS):
        raise _UnknownError
    try:
        told = thing.__reduce_ex__(4)
    except Exception as cause:  # what cannot be copied, for whatever reason, is unknown
        raise _UnknownError from cause
    kind = _told(type(thing), met)
    if isinstance(told, str):  # by its name: a function with a memory, say, with what it remembers the results of
        return kind + f"{getattr(thing, '__module__', '')}.{told}".encode() + _told(getattr(thing, "__dict__", {}), met)
    made_by, arguments, *state = told
    rest = [list(one) if hasattr(one, "__next__") else one for one in state]
    return kind + b"|".join(_told(one, met) for one in (made_by, arguments, rest))


def _module(module: ModuleType, met: _Met) -> bytes:
    """A module by its name; an author's own by its text, and those of all modules of an author that it reads."""
    found: dict[str, bytes] = {}
    left = [module]
    while left:
        one = left.pop()
        if one.__name__ in found or not by_an_author(one.__name__):
            continue
        folder = getattr(one, "__file__", None) is None and hasattr(one, "__path__")
        found[one.__name__] = b"" if folder else met.content(Path(getattr(one, "__file__", None) or ""))
        homes = {getattr(value, "__module__", None) for value in vars(one).values()}
        left += [value for value in vars(one).values() if isinstance(value, ModuleType)]
        left += [sys.modules[home] for home in homes if isinstance(home, str) and home in sys.modules]
    texts = [name.encode() + b":" + told for name, told in sorted(found.items())]
    return b"|".join([module.__name__.encode(), *texts])


def _all_of(module: ModuleType, met: _Met) -> bytes:
    """The same with all that stands in an author's module, where nobody tells what is read of it."""
    parts = [_module(module, met)]
    if by_an_author(module.__name__):
        held = sorted(name for name in vars(module) if not name.startswith("__"))
        parts += [name.encode() + _told(vars(module)[name], met) for name in held]
    return b"|".join(parts)


def _text_or_path(text: str, met: _Met) -> bytes:
    """A text; of one that is a path below a folder of Python's path, its place there, and its content if it is a file."""
    path, told = Path(text), text.encode("utf-8", "surrogatepass")
    roots = path.is_absolute() and [Path(f) for f in sys.path if len(f) > 1 and path.is_relative_to(f)]
    if not roots:
        return b"str:" + told
    inner = path.relative_to(min(roots, key=lambda root: len(root.parts))).as_posix()
    return b"path:" + inner.encode("utf-8", "surrogatepass") + (met.content(path) if _is_file(path) else b"")


def _is_file(path: Path) -> bool:
    try:
        return path.is_file()
    except (OSError, ValueError):  # no file can be called so
        return False
