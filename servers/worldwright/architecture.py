"""Draw the house on `servers/architecture.md` from the imports: `python -m worldwright.architecture` redraws it.

A room is a folder of `worldwright` (or one of the two packages beside it). An arrow says that a room imports another; what
follows from other arrows is left out. A test compares the page with the code.
"""

import ast
from collections import defaultdict
from pathlib import Path

SERVERS = Path(__file__).parents[1]
PAGE = SERVERS / "architecture.md"
BEGIN, END = "<!-- drawn by `python -m worldwright.architecture` -->\n", "<!-- end of the picture -->\n"
SPANNING = "build, cli, serve"
"""The common name of the single files at the top of `worldwright`."""


def rooms() -> dict[str, set[str]]:
    """Every room with the rooms that it imports."""
    found: dict[str, set[str]] = defaultdict(set)
    for path in sorted(SERVERS.rglob("*.py")):
        own = _room(path.relative_to(SERVERS).with_suffix("").parts)
        for parts in _imported(path):
            other = _room(parts)
            if other != own and own and other:
                found[own].add(other)
        found[own] |= set()
    found.pop("", None)
    return dict(found)


def picture() -> str:
    """The picture, as Mermaid."""
    graph = rooms()
    reach = {room: _reached(graph, room) for room in graph}
    lines = ["```mermaid", "flowchart BT"]
    lines += [f'  {_id(room)}["{room}"]' for room in sorted(graph)]
    for room in sorted(graph):
        for other in sorted(graph[room]):
            mutual = room in reach[other]
            implied = any(other in reach[by] and room not in reach[by] for by in graph[room] - {other})
            if mutual or not implied:
                lines.append(f"  {_id(room)} --> {_id(other)}")
    return "\n".join([*lines, "```", ""])


def page(text: str) -> str:
    """The page with its picture drawn anew."""
    head, _, rest = text.partition(BEGIN)
    return head + BEGIN + picture() + END + rest.partition(END)[2]


def _room(parts: tuple[str, ...]) -> str:
    if parts[0] in ("worldkit", "worldengine"):
        return parts[0]
    if parts[0] != "worldwright" or len(parts) < 2:
        return ""
    if (SERVERS / "worldwright" / parts[1]).is_dir():
        return parts[1]
    # The bases that everything uses are no room of their own; the other single files span the rooms.
    return "" if parts[1] in ("shelf", "expose", "paging", "schema", "architecture", "__init__") else SPANNING


def _imported(path: Path) -> set[tuple[str, ...]]:
    package = path.relative_to(SERVERS).with_suffix("").parts[:-1]
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            found |= {tuple(alias.name.split(".")) for alias in node.names}
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) - node.level + 1] if node.level else ()
            module = (*base, *(node.module.split(".") if node.module else ()))
            found |= {(*module, alias.name) for alias in node.names}
    return found


def _reached(graph: dict[str, set[str]], room: str) -> set[str]:
    found: set[str] = set()
    waiting = list(graph[room])
    while waiting:
        one = waiting.pop()
        if one not in found:
            found.add(one)
            waiting += graph.get(one, ())
    return found


def _id(room: str) -> str:
    return "".join(c for c in room if c.isalpha())


if __name__ == "__main__":
    PAGE.write_text(page(PAGE.read_text(encoding="utf-8")), encoding="utf-8")
