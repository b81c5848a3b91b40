"""Which rows set a coordinate of their subject, told from what the entries of the vocabulary pin in their own cases."""

from typing import Any

from ..shelf import Entry
from .anchors import CannotResolveError
from .vocabulary import CAMERA_FAMILY, PREDICATES, RELATIONS, ask


def setters(dof: str) -> str:
    """The names of the entries that set `x`, `y` or `z`, each with the parameters without which it does not."""
    words: dict[str, str] = {}
    for entry in (*PREDICATES.values(), *RELATIONS.values()):
        if entry.FAMILY != CAMERA_FAMILY and (needed := _needed(entry, dof)):
            ways = sorted({" and ".join(f"`{name}`" for name in names) for names in needed})
            words[_called(entry)] = f" with {' or '.join(ways)}" if all(ways) else ""
    return ", ".join(name + ways for name, ways in words.items())


def _needed(entry: Entry, dof: str) -> set[tuple[str, ...]]:
    """For each GOOD case that sets the coordinate: the optional parameters without which it would not."""
    found = set()
    for case in entry.GOOD:
        params = case.boxes()[2]
        if _sets(entry, dof, params):
            optional = [name for name in params if name in entry.PARAMS and not entry.PARAMS[name].required]
            without = {name: {k: v for k, v in params.items() if k != name} for name in optional}
            found.add(tuple(name for name in optional if not _sets(entry, dof, without[name])))
    return found


def _sets(entry: Entry, dof: str, params: dict[str, Any]) -> bool:
    try:
        return dof in ask(entry, "pins", params)
    except CannotResolveError:
        return False


def _called(entry: Entry) -> str:
    """The entry's name; the faces of one module share theirs, e.g. `adjacent_*`."""
    family = entry.module.__name__.rsplit(".", 1)[-1]
    return f"{family}_*" if entry.part is not entry.module and entry.code.startswith(f"{family}_") else entry.code
