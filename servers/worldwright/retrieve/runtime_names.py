"""Public names of worldkit by import: what a package hands on from its modules, methods of its classes, inherited ones too.

The index knows definitions where they are written; programs name them where they import them (`worldkit.filming.Film.mesh`).
"""

import importlib
import inspect
import pkgutil
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Named:
    """One public name."""

    dotted: str
    """As a program reaches it, from `worldkit` on."""
    kind: str
    signature: str
    documentation: str
    members: tuple[str, ...]
    path: str
    """Of the file that it is written in, `worldkit/…`."""
    anchor: str
    """What the index calls it there."""


def find(path: list[str]) -> Named | None:
    """What a dotted path (without `worldkit`) stands for: from the package on, or from a class or function of any module of it."""
    if any(part.startswith("_") for part in path):
        return None
    for module in ("worldkit", *_modules()):
        found = _below(module, path)
        if found is not None:
            return found
    return None


def _modules() -> Iterator[str]:
    """`worldkit.filming` first, whose names are used most without it; then every other."""
    import worldkit

    names = sorted(one.name for one in pkgutil.iter_modules(worldkit.__path__) if not one.name.startswith("_"))
    yield from (f"worldkit.{name}" for name in sorted(names, key=lambda name: name != "filming"))


def _below(module: str, path: list[str]) -> Named | None:
    import worldkit

    thing: Any = importlib.import_module(module)
    owner: Any = None
    for part in path:
        owner, before = thing, getattr(thing, "__name__", "")
        thing = getattr(thing, part, None)
        if thing is None and inspect.ismodule(owner) and hasattr(owner, "__path__"):
            try:
                thing = importlib.import_module(f"{before}.{part}")
            except ModuleNotFoundError:
                return None
        if thing is None:
            return _own(module, path, owner) if part == path[-1] and inspect.isclass(owner) else None
    if isinstance(thing, dict | tuple | list | str | int | float | frozenset) and inspect.ismodule(owner):
        said = ", ".join(map(str, thing)) if isinstance(thing, dict | tuple | list | frozenset) else repr(thing)
        return Named(f"{module}.{'.'.join(path)}", "value", "", said, (), _file(owner), _title(owner))
    if isinstance(thing, property):
        thing = thing.fget  # which knows its module
    home = thing.__name__ if inspect.ismodule(thing) else getattr(thing, "__module__", "")
    if not str(home).startswith(f"{worldkit.__name__}."):
        return None
    return _named(f"{module}.{'.'.join(path)}", thing, inspect.isclass(owner))


def _named(dotted: str, thing: Any, of_class: bool) -> Named:
    home = importlib.import_module(thing.__name__ if inspect.ismodule(thing) else thing.__module__)
    members: tuple[str, ...] = ()
    kind = "method" if of_class else "function"
    if inspect.isclass(thing) or inspect.ismodule(thing):
        kind = "class" if inspect.isclass(thing) else "module"
        listed = getattr(thing, "__all__", None) or dir(thing)
        members = tuple(name for name in listed if not name.startswith("_"))
    signature = ""
    if callable(thing):
        try:
            signature = f"{dotted.rsplit('.', 1)[-1]}{inspect.signature(thing)}"
        except (TypeError, ValueError):
            signature = ""
    anchor = thing.__qualname__ if not inspect.ismodule(thing) else _title(home)
    return Named(dotted, kind, signature, inspect.getdoc(thing) or "", members, _file(home), anchor)


def _own(module: str, path: list[str], owner: type) -> Named | None:
    """What an object of a class has of its own: a field, or what `__init__` sets, with the words that follow it."""
    for cls in owner.__mro__[:-1]:
        found = re.search(
            rf'^    (?:    self\.)?{re.escape(path[-1])}(?:: .*| = .*)$(?:\n +"""(.*?)""")?',
            inspect.getsource(cls),
            re.MULTILINE,
        )
        if found:
            words = found[1] or inspect.getdoc(cls) or ""
            line = found[0].strip().splitlines()[0].removeprefix("self.")
            home = importlib.import_module(cls.__module__)
            return Named(f"{module}.{'.'.join(path)}", "field", line, words, (), _file(home), cls.__qualname__)
    return None


def _title(home: Any) -> str:
    """What the index calls a module."""
    return f"{home.__name__}.__init__" if hasattr(home, "__path__") else str(home.__name__)


def _file(home: Any) -> str:
    inside = str(home.__file__).replace("\\", "/").rsplit("/worldkit/", 1)[-1]
    return f"worldkit/{inside}"
