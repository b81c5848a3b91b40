"""A short text for what something is made of: equal texts, equal things. What is kept of earlier runs is found by it."""

import hashlib
from pathlib import Path
from types import CodeType, FunctionType, ModuleType
from typing import Any

import numpy as np


def signature(*things: Any) -> str:
    """Differs when the things differ: numbers, texts, arrays, shapes, functions with all that they read.

    Of what it does not know it takes the `repr`, which tells too many things apart rather than too few.
    """
    digest, seen = hashlib.sha256(), set()  # type: ignore[var-annotated]
    for thing in things:
        digest.update(_told(thing, seen) + b"\0")
    return digest.hexdigest()[:24]


def _told(thing: Any, seen: set[int]) -> bytes:
    recipe = getattr(thing, "recipe", None)
    if isinstance(recipe, str):
        return recipe.encode()
    if isinstance(thing, np.ndarray):
        return f"{thing.dtype}{thing.shape}".encode() + np.ascontiguousarray(thing).tobytes()
    if isinstance(thing, list | tuple):
        return b"[" + b",".join(_told(one, seen) for one in thing) + b"]"
    if isinstance(thing, dict):
        return b"{" + b",".join(_told(pair, seen) for pair in sorted(thing.items(), key=repr)) + b"}"
    if isinstance(thing, CodeType):
        return thing.co_code + repr(thing.co_names).encode() + _told(thing.co_consts, seen)
    if isinstance(thing, FunctionType):
        return _function(thing, seen)
    return f"{type(thing).__name__}:{thing!r}".encode()


def _function(function: FunctionType, seen: set[int]) -> bytes:
    """A function by its instructions, defaults, what it closes over, and what it reads of its module and those beside it."""
    if id(function) in seen:
        return b"again"
    seen.add(id(function))
    parts = [_told(function.__code__, seen), _told(function.__defaults__ or (), seen)]
    for cell in function.__closure__ or ():
        parts.append(_told(cell.cell_contents, seen))
    here = Path(function.__code__.co_filename).parent
    for name in sorted(_names(function.__code__)):
        if name not in function.__globals__:
            continue
        value = function.__globals__[name]
        home = value if isinstance(value, ModuleType) else None
        if home is None and getattr(value, "__module__", None) != function.__module__ and callable(value):
            continue  # it comes from elsewhere, whose text or version is looked at below
        if home is None:
            parts.append(name.encode() + _told(value, seen))
    parts += [_text(value, here) for value in function.__globals__.values()]
    return b"|".join(parts)


def _names(code: CodeType) -> set[str]:
    inner = (constant for constant in code.co_consts if isinstance(constant, CodeType))
    return set(code.co_names).union(*(_names(one) for one in inner))


def _text(value: Any, folder: Path) -> bytes:
    """The text of a module that lies beside an author's own, or of the one that a thing comes from."""
    import sys

    module = value if isinstance(value, ModuleType) else sys.modules.get(getattr(value, "__module__", None) or "")
    file = getattr(module, "__file__", None)
    if not file or Path(file).parent != folder:
        return b""
    try:
        return hashlib.sha256(Path(file).read_bytes()).digest()
    except OSError:
        return file.encode()
