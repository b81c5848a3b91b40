"""A shelf is a folder of one-idea modules: a lint rule, an anomaly check, a predicate, an expectation.

The folder is the registry. Each module's docstring is its documentation, its cases are its tests, and its one verb is
its code. A shelf declares what its entries must define; a malformed entry fails naming file and line. Third parties
add entries through the entry-point group `worldwright.<shelf>` (each entry point names a module).
"""

import importlib
import pkgutil
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from importlib.metadata import entry_points
from types import ModuleType
from typing import Any

from .model.errors import NotFoundError


class MalformedEntryError(Exception):
    """A shelf module lacks something its shelf requires; the message is `file:line: what`."""


@dataclass(frozen=True)
class Entry:
    """One module on a shelf."""

    name: str
    """The module's name: the defect or the relation, e.g. `zero_timestep`."""
    code: str
    """Its `CODE`, e.g. `WL101` or `PLACE-ON`."""
    module: ModuleType

    @property
    def summary(self) -> str:
        """The first sentence of the docstring."""
        return (self.module.__doc__ or "").strip().split("\n\n")[0].replace("\n", " ")

    @property
    def doc(self) -> str:
        """The whole docstring."""
        return (self.module.__doc__ or "").strip()

    def __getattr__(self, attribute: str) -> Any:
        return getattr(self.module, attribute)


class Shelf(Mapping[str, Entry]):
    """The entries of one folder by code, loaded when first looked at.

    Args:
        package: dotted name of the folder's package, e.g. `worldwright.lint.rules`.
        requires: names every module must define, with the type each must have (`object` for any).
    """

    def __init__(self, package: str, requires: dict[str, type | tuple[type, ...]]) -> None:
        self.package = package
        self.requires = {"CODE": str, **requires}

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """Every entry by code, in the order of the codes."""
        package = importlib.import_module(self.package)
        modules = [
            importlib.import_module(info.name)
            for info in pkgutil.walk_packages(package.__path__, self.package + ".")
            if not info.ispkg and not info.name.rsplit(".", 1)[1].startswith("_")
        ]
        group = self.package
        modules += [importlib.import_module(point.value) for point in entry_points(group=group)]
        found: dict[str, Entry] = {}
        for module in modules:
            entry = self._entry(module)
            if entry.code in found:
                raise MalformedEntryError(
                    f"{module.__file__}:1: CODE {entry.code!r} is already taken by {found[entry.code].module.__file__}"
                )
            found[entry.code] = entry
        return dict(sorted(found.items()))

    def _entry(self, module: ModuleType) -> Entry:
        if not (module.__doc__ or "").strip():
            raise MalformedEntryError(f"{module.__file__}:1: a shelf entry needs a docstring: it is its documentation")
        for name, kind in self.requires.items():
            if not hasattr(module, name):
                raise MalformedEntryError(f"{module.__file__}:1: a {self.package} entry must define {name}")
            if not isinstance(getattr(module, name), kind):
                raise MalformedEntryError(f"{module.__file__}:{_line_of(module, name)}: {name} must be a {kind}")
        return Entry(module.__name__.rsplit(".", 1)[1], module.CODE, module)

    def __getitem__(self, key: str) -> Entry:
        if key in self.entries:
            return self.entries[key]
        for entry in self.entries.values():
            if entry.name == key:
                return entry
        raise KeyError(key)

    def find(self, key: str) -> Entry:
        """The entry with this code or name, or a `NotFoundError` that lists the nearest known ones."""
        try:
            return self[key]
        except KeyError:
            from difflib import get_close_matches

            names = [*self.entries, *(e.name for e in self.entries.values())]
            near = get_close_matches(key, names, n=3, cutoff=0.5)
            raise NotFoundError(
                f"'{key}' is not on the shelf {self.package}",
                next_move=("did you mean " + ", ".join(near) + "? " if near else "")
                + "known: "
                + ", ".join(f"{e.name} ({e.code})" for e in self.entries.values()),
            ) from None

    def __iter__(self) -> Iterator[str]:
        return iter(self.entries)

    def __len__(self) -> int:
        return len(self.entries)


def _line_of(module: ModuleType, name: str) -> int:
    from inspect import getsourcelines

    for number, line in enumerate(getsourcelines(module)[0], 1):
        if line.startswith((f"{name} ", f"{name}:", f"{name}=", f"def {name}(")):
            return number
    return 1
