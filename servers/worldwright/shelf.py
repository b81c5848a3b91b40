"""A shelf is a folder of one-idea modules: a lint rule, an anomaly check, a predicate, an expectation.

The folder is the registry. Each module's docstring is its documentation, its cases are its tests, and its one verb is
its code. A shelf's protocol says what an entry defines, each attribute with its meaning; whoever runs the entries can
read nothing else of them, and a malformed one fails naming file and line. Where one idea has several faces, a module
lists them as `ENTRIES`: objects with a `name`, a `doc` and the same attributes.

Third parties add entries through the entry-point group that has the shelf's dotted name (each entry point names a
module). One that cannot be loaded takes nothing down with it: it is listed in `unusable`, with the reason.
"""

import importlib
import pkgutil
from collections.abc import Callable, Iterable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from importlib.metadata import entry_points
from types import ModuleType
from typing import Any

from .model.errors import NotFoundError

Function: Any = Callable
"""The kind of an attribute that is called."""
REQUIRED: Any = object()


class MalformedEntryError(Exception):
    """A shelf module lacks something its shelf requires; the message is `file:line: what`."""


@dataclass(frozen=True)
class Attribute:
    """An attribute that an entry of a shelf must or may define."""

    kind: Any
    """One type or several, `object` for any, `Function` for what is called."""
    meaning: str
    default: Any = REQUIRED
    """The value of an entry without it; an attribute without a default must be defined."""

    @property
    def required(self) -> bool:
        """Whether every entry must define it."""
        return self.default is REQUIRED


@dataclass(frozen=True)
class Entry:
    """One entry of a shelf, whose attributes are those that its protocol names."""

    name: str
    """The defect or the relation, e.g. `zero_timestep`: the module's name, or that of one face of several."""
    code: str
    """Its `CODE`, e.g. `WL101` or `PLACE-ON`."""
    module: ModuleType
    part: Any = field(repr=False)
    """The module itself, or one of its `ENTRIES`."""
    protocol: Mapping[str, Attribute] = field(repr=False, hash=False, compare=False)

    @property
    def summary(self) -> str:
        """The first sentence of the documentation."""
        return self.doc.split("\n\n")[0].replace("\n", " ")

    @property
    def doc(self) -> str:
        """The whole documentation."""
        return _doc(self.part)

    def __getattr__(self, attribute: str) -> Any:
        if attribute.startswith("__"):
            raise AttributeError(attribute)
        if attribute not in self.protocol:
            raise AttributeError(f"{attribute} is not in the protocol of its shelf: {', '.join(self.protocol)}")
        for owner in (self.part, self.module):
            if hasattr(owner, attribute):
                return getattr(owner, attribute)
        return self.protocol[attribute].default


class Shelf(Mapping[str, Entry]):
    """The entries of one folder by code, loaded when first looked at.

    Args:
        package: dotted name of the folder's package, e.g. `worldwright.lint.rules`.
        protocol: the attributes of an entry, by name; `CODE` is added to them.
    """

    def __init__(self, package: str, protocol: Mapping[str, Attribute]) -> None:
        self.package = package
        self.protocol = {"CODE": Attribute(str, "its code, never used again"), **protocol}
        self.unusable: dict[str, str] = {}
        """The reason why a third party's entry could not be loaded, by the name of its entry point."""

    @cached_property
    def entries(self) -> dict[str, Entry]:
        """Every entry by code, in the order of the codes."""
        package = importlib.import_module(self.package)
        found: dict[str, Entry] = {}
        for info in pkgutil.walk_packages(package.__path__, self.package + "."):
            if not info.ispkg and not info.name.rsplit(".", 1)[1].startswith("_"):
                self._add(found, self._entries(importlib.import_module(info.name)))
        for point in entry_points(group=self.package):
            try:
                self._add(found, self._entries(importlib.import_module(point.value)))
            except Exception as defect:  # it is somebody else's code: whatever it raises, the shelf works
                self.unusable[point.name] = f"{point.value} cannot be loaded: {type(defect).__name__}: {defect}"
        return dict(sorted(found.items()))

    def explained(self) -> str:
        """The protocol as a table: every attribute, whether it must be there, and what it means."""
        rows = [
            f"| `{name}` | {'yes' if attribute.required else f'no: {attribute.default!r}'} | {attribute.meaning} |"
            for name, attribute in self.protocol.items()
        ]
        return "\n".join(["| an entry defines | needed | what it means |", "|---|---|---|", *rows])

    def _add(self, found: dict[str, Entry], entries: Iterable[Entry]) -> None:
        new = list(entries)
        for entry in new:
            if entry.code in found:
                raise MalformedEntryError(
                    f"{entry.module.__file__}:1: CODE {entry.code!r} is already taken by "
                    f"{found[entry.code].module.__file__}"
                )
        found.update((entry.code, entry) for entry in new)

    def _entries(self, module: ModuleType) -> Iterator[Entry]:
        for part in getattr(module, "ENTRIES", (module,)):
            yield self._entry(module, part)

    def _entry(self, module: ModuleType, part: Any) -> Entry:
        if not _doc(part):
            raise MalformedEntryError(f"{module.__file__}:1: a shelf entry needs a docstring: it is its documentation")
        for name, attribute in self.protocol.items():
            owner = next((o for o in (part, module) if hasattr(o, name)), None)
            if owner is None and attribute.required:
                raise MalformedEntryError(f"{module.__file__}:1: a {self.package} entry must define {name}")
            if owner is not None and not isinstance(getattr(owner, name), attribute.kind):
                raise MalformedEntryError(
                    f"{module.__file__}:{_line_of(module, name)}: {name} must be a {attribute.kind}"
                )
        name = module.__name__.rsplit(".", 1)[-1] if part is module else part.name
        code = part.CODE if hasattr(part, "CODE") else module.CODE
        return Entry(name, code, module, part, self.protocol)

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


def failed(entry: Entry, defect: Exception) -> str:
    """The words about an entry that raised, with its name and its error, so that nobody takes silence for a yes."""
    return f"{entry.name} ({entry.code}) itself failed ({type(defect).__name__}: {defect}); report it with this input"


def _doc(part: Any) -> str:
    said = part.__doc__ if isinstance(part, ModuleType) else getattr(part, "doc", "")
    return (said or "").strip()


def _line_of(module: ModuleType, name: str) -> int:
    from inspect import getsourcelines

    for number, line in enumerate(getsourcelines(module)[0], 1):
        if line.startswith((f"{name} ", f"{name}:", f"{name}=", f"def {name}(")):
            return number
    return 1
