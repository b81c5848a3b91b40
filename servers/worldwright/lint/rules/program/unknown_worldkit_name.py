"""A worldkit function or keyword does not exist.

What it does: resolves every `worldkit.…` name, and the keywords of every call, against the installed runtime's sources.

Why is this bad: the program fails in its first pass. worldkit is small and its names cannot be guessed.

Use instead: the nearest existing name or keyword, named in the finding.
"""

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from ... import worldkit_api
from ...harm import Raises
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL106"
ABOUT = "names"
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "from worldkit import contacts\nFELT = contacts.surface(friction=0.2)\n",
    "import worldkit.files\nworldkit.files.write_json\n",
)
BAD = (
    "from worldkit import physics\n",
    "from worldkit import contacts\nFELT = contacts.material(friction=0.2)\n",
    "from worldkit import contacts\nFELT = contacts.surface(fricton=0.2)\n",
    "from worldkit.contacts import surfaces\n",
)
EVIDENCE = Raises()


def check(program: Program) -> Iterator[Problem]:
    """Check imports, attributes, then keywords."""
    for node in program.nodes(ast.ImportFrom, ast.Import):
        if program.is_guarded(node):
            continue
        for alias in node.names:
            module = node.module if isinstance(node, ast.ImportFrom) else None
            full = f"{module}.{alias.name}" if module else alias.name
            if alias.name != "*" and getattr(node, "level", 0) == 0:
                yield from _resolve(node, full)
    for node in program.nodes(ast.Attribute):
        full = program.dotted(node)
        if full is not None and not program.is_guarded(node):
            yield from _resolve(node, full)
    for full, call in program.calls("worldkit."):
        parts = full.split(".")
        known = worldkit_api.callee(".".join(parts[1:-1]), parts[-1]) if len(parts) > 2 else None
        if known is None or known.open:
            continue
        for keyword in call.keywords:
            if keyword.arg is not None and keyword.arg not in known.parameters:
                near = get_close_matches(keyword.arg, known.parameters, n=2, cutoff=0.5)
                fix = f"nearest: {', '.join(near)}" if near else f"it takes: {', '.join(known.parameters)}"
                yield at(keyword.value, f"`{full}` takes no `{keyword.arg}`", fix)


def _resolve(node: ast.AST, full: str) -> Iterator[Problem]:
    parts = full.split(".")
    if parts[0] != "worldkit" or len(parts) < 2 or parts[-1].startswith("__"):
        return
    modules = worldkit_api.modules()
    if parts[1] not in modules:
        if len(parts) == 2:
            yield _missing(node, full, parts[1], modules)
        return
    names = worldkit_api.names(parts[1])
    if len(parts) == 3 and names is not None and parts[2] not in names:
        yield _missing(node, full, parts[2], [n for n in names if not n.startswith("_")])


def _missing(node: ast.AST, full: str, name: str, known: list[str]) -> Problem:
    near = get_close_matches(name, known, n=3, cutoff=0.5)
    fix = f"nearest: {', '.join(near)}" if near else f"known: {', '.join(known)}"
    return at(node, f"worldkit has no `{full.removeprefix('worldkit.')}`", fix)
