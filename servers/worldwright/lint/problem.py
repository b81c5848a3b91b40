"""What a rule yields: a place, a cause and a fix. The engine adds the rule's code, name and severity."""

import ast
from dataclasses import dataclass

from ..model.finding import Severity

NOT_TRIED = "not tried"
"""Said of a file that nothing but reading has judged, although it would have to be tried."""


@dataclass(frozen=True)
class Edit:
    """A stretch of the source, and what to write in its place."""

    line: int
    column: int
    """1-based, in characters."""
    end_line: int
    end_column: int
    """The first column that stays."""
    text: str


@dataclass(frozen=True)
class Problem:
    """One hit of one rule."""

    message: str
    """The cause, in one sentence."""
    fix: str = ""
    """What to do about it, in one sentence."""
    line: int | None = None
    column: int | None = None
    end_line: int | None = None
    section: str | None = None
    severity: Severity | None = None
    """Overrides the rule's own severity."""
    edit: Edit | None = None
    """A change that mends it and cannot break anything; applied by `--fix`."""


def at(
    node: ast.AST, message: str, fix: str = "", severity: Severity | None = None, edit: Edit | None = None
) -> Problem:
    """A problem at a syntax node."""
    line = getattr(node, "lineno", 1)
    return Problem(
        message,
        fix,
        line,
        getattr(node, "col_offset", 0) + 1,
        getattr(node, "end_lineno", None) or line,
        severity=severity,
        edit=edit,
    )
