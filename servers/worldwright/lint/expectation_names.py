"""The names of the expectations and how they are marked, read from the files of their shelf.

The engine that measures them belongs to another server, so nothing of it is imported: a mark is a line such as
`LASTING = True` of a module. Plug-ins are read from the modules that their entry points name.
"""

import ast
from functools import cache
from importlib.metadata import entry_points
from importlib.util import find_spec
from pathlib import Path

from ..model import syntax

GROUP = "worldwright.scan.objectives.expectations"
FOLDER = Path(__file__).parents[1] / "scan" / "objectives" / "expectations"


@cache
def vocabulary() -> tuple[str, ...]:
    """Every name, in the order of the alphabet."""
    return tuple(sorted(_files()))


@cache
def marked(mark: str, value: bool = True) -> frozenset[str]:
    """The names of the expectations whose module sets a mark to this value."""
    return frozenset(name for name, path in _files().items() if path is not None and _sets(path, mark, value))


def _files() -> dict[str, Path | None]:
    """The file of each expectation by its name; None where a plug-in has none that can be found."""
    found: dict[str, Path | None] = {p.stem: p for p in FOLDER.rglob("*.py") if not p.stem.startswith("_")}
    for point in entry_points(group=GROUP):
        try:
            spec = find_spec(point.value)
        except (ImportError, ValueError):
            spec = None
        found[point.name] = Path(spec.origin) if spec is not None and spec.origin else None
    return found


def _sets(path: Path, mark: str, value: bool) -> bool:
    try:
        tree = syntax.module(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError):
        return False
    return any(
        isinstance(node, ast.Assign)
        and any(isinstance(target, ast.Name) and target.id == mark for target in node.targets)
        and isinstance(node.value, ast.Constant)
        and node.value.value is value
        for node in tree.body
    )
