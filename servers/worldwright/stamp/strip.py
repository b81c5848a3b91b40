"""Take review instrumentation out of a program and leave every other byte as it was.

Instrumentation is marked by comments:

- everything from ``# worldwright: begin instrumentation`` to ``# worldwright: end instrumentation``, both included;
- a line that ends with ``# worldwright: instrumentation``. On the first or last line of a statement it marks the whole
  statement (a loop or a function with its body); on a line inside brackets it marks that line alone.

A block that would be left empty gets a ``pass``. The marks count only as comments, never inside strings. What is left
must parse, must hold exactly the other statements, and no statement may be cut in half.

Not libcst: it removes nodes, and with a node the comments above it, where marks take out lines, some of them inside
brackets. It takes 0.3 s to import and 83 ms to place the nodes of our longest program, which is stripped here in 11.
"""

import ast
import io
import re
import tokenize
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ..model import syntax
from ..model.errors import WorldwrightError

BEGIN = "# worldwright: begin instrumentation"
END = "# worldwright: end instrumentation"
LINE = "# worldwright: instrumentation"
WHOLE = f"mark whole statements: put them between `{BEGIN}` and `{END}`"


class InstrumentationError(WorldwrightError):
    """The instrumentation marks of a program contradict each other or cut a statement in half."""

    code = "instrumentation"


@dataclass(frozen=True)
class Stripped:
    """A program without its instrumentation."""

    source: str
    removed: tuple[int, ...]
    """Line numbers taken out, 1-based, in the original."""


def strip(source: str, file: str = "simulation.py") -> Stripped:
    """`source` without its instrumentation; unbalanced or misplaced marks are an `InstrumentationError`."""
    tree = _parse(source, file)
    removed = _removed(source, tree, file)
    if not removed:
        return Stripped(source, ())
    lines = re.split(r"(?<=\n)|(?<=\r)(?!\n)", source)  # not splitlines: it also splits inside some strings
    passes = dict(_emptied(tree, lines, removed))
    kept = []
    for number, text in enumerate(lines, 1):
        if number in passes:
            kept.append(" " * passes[number] + "pass" + text[len(text.rstrip("\r\n")) :])
        elif number not in removed:
            kept.append(text)
    result = "".join(kept)
    try:
        left = syntax.module(result)
    except (SyntaxError, ValueError) as cause:
        raise InstrumentationError(
            f"without its instrumentation the program is not valid Python: {cause}",
            place=f"{file}:{min(removed)}",
            next_move=WHOLE,
        ) from cause
    if _shape(tree, removed, passes) != _shape(left, set(), {}):
        raise InstrumentationError(
            "taking the instrumentation out would change the statements around it",
            place=f"{file}:{min(removed)}",
            next_move=WHOLE,
        )
    return Stripped(result, tuple(sorted(removed)))


def _parse(source: str, file: str) -> ast.Module:
    try:
        return syntax.module(source)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as cause:
        raise InstrumentationError(
            f"the program does not parse: {cause}",
            place=f"{file}:{getattr(cause, 'lineno', None) or 1}",
            next_move=f"worldwright lint check-program {file}",
        ) from cause


def _removed(source: str, tree: ast.Module, file: str) -> set[int]:
    """The lines that the marks take out, checked not to cut any statement."""
    removed: set[int] = set()
    opened: int | None = None
    for line, mark in _marks(source):
        if mark == LINE:
            removed |= _statement_at(tree, line)
        elif mark == BEGIN and opened is None:
            opened = line
        elif mark == END and opened is not None:
            removed |= set(range(opened, line + 1))
            opened = None
        else:
            raise InstrumentationError(
                f"`{mark}` inside an open block" if mark == BEGIN else f"`{mark}` closes nothing",
                place=f"{file}:{line}",
                next_move="pair every begin mark with one end mark; blocks do not nest",
            )
    if opened is not None:
        raise InstrumentationError(
            "an instrumentation block is never closed", place=f"{file}:{opened}", next_move=f"add `{END}`"
        )
    for node in _statements(tree):
        start, end = _span(node)
        last = start if _compound(node) else end
        if not _gone(node, removed) and (start in removed or last in removed):
            raise InstrumentationError(
                "an instrumentation mark cuts the statement here in half", place=f"{file}:{start}", next_move=WHOLE
            )
    return removed


def _marks(source: str) -> Iterator[tuple[int, str]]:
    """(line, mark) of every comment that is a mark, in order."""
    for token in tokenize.generate_tokens(io.StringIO(source, newline="").readline):
        if token.type == tokenize.COMMENT:
            text = token.string.rstrip()
            mark = next((mark for mark in (BEGIN, END, LINE) if text.endswith(mark)), None)
            if mark:
                yield token.start[0], mark


def _statements(tree: ast.AST) -> list[ast.stmt]:
    return [node for node in ast.walk(tree) if isinstance(node, ast.stmt)]


def _span(node: Any) -> tuple[int, int]:
    """First and last line, decorators included."""
    start = node.pattern.lineno if isinstance(node, ast.match_case) else node.lineno
    last = node.body[-1] if isinstance(node, ast.match_case) else node
    return min([start, *(d.lineno for d in getattr(node, "decorator_list", ()))]), int(last.end_lineno or start)


def _gone(node: Any, removed: set[int]) -> bool:
    start, end = _span(node)
    return removed.issuperset(range(start, end + 1))


def _statement_at(tree: ast.Module, line: int) -> set[int]:
    """The lines one line mark takes out: the widest statement that starts (or simply ends) there, else the line."""
    for node in _statements(tree):  # widest first
        start, end = _span(node)
        if line in (start, node.lineno) or (line == end and not _compound(node)):
            return set(range(start, end + 1))
    return {line}


def _compound(node: ast.AST) -> bool:
    return hasattr(node, "body") or hasattr(node, "cases")


def _blocks(node: ast.AST) -> list[tuple[str, list[ast.stmt]]]:
    """The blocks of statements directly under a node, each of which may not be empty, with their field names."""
    found = [(name, getattr(node, name, None)) for name in ("body", "orelse", "finalbody")]
    return [(name, block) for name, block in found if isinstance(block, list) and block]


def _emptied(node: ast.AST, lines: list[str], removed: set[int]) -> Iterator[tuple[int, int]]:
    """(line, column) where a `pass` must stand, because a kept block lost all its statements."""
    for name, block in _blocks(node):
        first = _span(block[0])[0]
        if isinstance(node, ast.Module) or not all(_gone(child, removed) for child in block):
            continue
        if name == "body" or _header(lines, name, first) not in removed:
            yield first, block[0].col_offset
    for child in _children(node, removed):
        yield from _emptied(child, lines, removed)


def _children(node: ast.AST, removed: set[int]) -> list[ast.AST]:
    """The kept statements, handlers and cases directly under a node."""
    kinds = (ast.stmt, ast.ExceptHandler, ast.match_case)
    return [c for c in ast.iter_child_nodes(node) if isinstance(c, kinds) and not _gone(c, removed)]


def _shape(node: ast.AST, removed: set[int], passes: dict[int, int]) -> tuple:
    """What statements stand where, once the removed ones are gone: (kind, children by field)."""
    parts: list[tuple] = []
    for name in ("body", "handlers", "cases", "orelse", "finalbody"):
        block = getattr(node, name, None)
        if isinstance(block, list) and block:
            kept = tuple(_shape(child, removed, passes) for child in block if not _gone(child, removed))
            kept = kept or ((("Pass", ()),) if _span(block[0])[0] in passes else ())
            parts += [(name, kept)] if kept else []
    return type(node).__name__, tuple(parts)


def _header(lines: list[str], name: str, first: int) -> int:
    """The line of the `else`, `elif` or `finally` that opens a block whose first statement is on line `first`."""
    words = ("finally",) if name == "finalbody" else ("else", "elif")
    for line in range(first, 0, -1):
        if lines[line - 1].lstrip().startswith(words):
            return line
    return first
