"""The plan was begun from another world, and places of it still stand as they were copied.

What it does: names, in one finding, every line on which `TO_CHANGE` stands, as `worldwright plan new` writes it.

Why is this bad: a number that was right for another world says nothing of this one. Nobody has decided what nobody has read.

Use instead: make the section say what the sentence asks for, then remove its `TO_CHANGE` line. A section that needs no change
loses the line too: that says somebody looked.
"""

from collections.abc import Iterator

from ....model.plan.committed import TO_CHANGE
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP133"
SEVERITY = "error"
GOOD: Changes = ({}, {"title": "Everything here was looked at"})
BAD: Changes = (
    {"objectives": [{"claim": "TO_CHANGE: it slides", "expect": [{"moves": {"body": "crate"}}]}]},
    {"title": "TO_CHANGE"},
)
EVIDENCE = Argued("the mark itself says that a choice is still open; no run reads it")


def check(view: PlanView) -> Iterator[Problem]:
    """All marks together."""
    if not (found := view.plan.copied):
        return
    first = found[0]
    where = ", ".join(f"line {place}" if isinstance(place, int) else place for place in found)
    yield Problem(
        f"still as copied from another world: {where}",
        f"decide each for this sentence, then remove its {TO_CHANGE} mark",
        first if isinstance(first, int) else None,
        section="plan" if isinstance(first, int) else first.partition(".")[0],
    )
