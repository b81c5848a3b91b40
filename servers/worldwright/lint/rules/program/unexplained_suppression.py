"""A finding is suppressed without a reason, or a suppression names no rule.

What it does: looks at every `# worldwright: ignore[…]` comment.

Why is this bad: a suppression is a decision; without its reason nobody can tell later whether it still holds.

Use instead: `# worldwright: ignore[WL135] the ghost marks the target pose and is declared visual_only`.
"""

import re
from collections.abc import Iterator

from ... import suppression
from ...case import Case
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL199"
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "x = 1  # worldwright: ignore[WL135] it is a ghost, declared visual_only\n",
    "text = '# worldwright: ignore[WL135]'\n",
    "# worldwright: begin instrumentation\n",
    Case("<mujoco>\n  <!-- worldwright: ignore[WM112] a press fit -->\n</mujoco>", path="a.xml"),
)
BAD = (
    "x = 1  # worldwright: ignore[WL135]\n",
    "x = 1  # worldwright: ignore everything\n",
    "x = 1  # worldwright: ignore[E501] long line\n",
    Case("<mujoco>\n  <!-- worldwright: ignore[WM112] -->\n</mujoco>", path="a.xml"),
)
EVIDENCE = Argued("a comment does nothing when it runs; who reads it later misses the reason")


def check(program: Program) -> Iterator[Problem]:
    """Check every suppression comment."""
    for comment in suppression.of(program.source):
        if not comment.codes or not all(re.fullmatch(r"W[LMPR]\d{3}", code) for code in comment.codes):
            yield Problem("the comment names no rule to ignore", "name it: ignore[WL123] reason", comment.line)
        elif not comment.reason:
            yield Problem("the suppression gives no reason", "say why after the bracket", comment.line)
