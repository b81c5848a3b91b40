"""A shelf module (a lint rule, a check, a predicate …) as one piece: its docstring is its page."""

import ast
from collections.abc import Iterator

from ..model import syntax
from .chunk import Chunk


def parse(text: str) -> ast.Module | None:
    """The module's syntax tree, or None when it is not Python."""
    try:
        return syntax.module(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError):
        return None


def chunks(text: str, name: str) -> Iterator[Chunk]:
    """The module's docstring, under its CODE when it has one; read, never imported."""
    tree = parse(text)
    if tree is None:
        return
    doc = ast.get_docstring(tree)
    if not doc:
        return
    code = next(
        (
            str(node.value.value)
            for node in tree.body
            if isinstance(node, ast.Assign)
            and isinstance(node.value, ast.Constant)
            and any(isinstance(t, ast.Name) and t.id == "CODE" for t in node.targets)
        ),
        name,
    )
    end = tree.body[0].end_lineno or 1
    yield Chunk(code, f"{code} {name}", 1, end, doc, (code, name))
