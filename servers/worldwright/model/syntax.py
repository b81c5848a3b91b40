"""Read Python's syntax, one text at a time.

CPython 3.11 counts how deep the tree under way is in a place that all threads share: one that parses beside another may end in a
`SystemError`.
"""

import ast
import threading

_ALONE = threading.RLock()


def module(source: str | bytes, filename: str = "<unknown>") -> ast.Module:
    """The tree of a module; raises what `ast.parse` raises."""
    with _ALONE:
        return ast.parse(source, filename)


def expression(text: str) -> ast.expr:
    """The tree of an expression; raises what `ast.parse` raises."""
    with _ALONE:
        return ast.parse(text, mode="eval").body
