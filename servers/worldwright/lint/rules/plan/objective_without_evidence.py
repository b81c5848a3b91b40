"""An objective has nothing that could prove it.

What it does: reports objectives with neither `expect` nor `visual_only`.

Why is this bad: the claim can never be accepted: an outcome is proved by measurements on the recorded state.

Use instead: one or more expectations with tolerances, or `visual_only: why it cannot be measured`.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP103"
SEVERITY = "error"
GOOD: Changes = (
    {},
    {"objectives": [{"claim": "It falls.", "expect": [{"falls": {"body": "crate"}}]}]},
)
BAD: Changes = (
    {"objectives": [{"claim": "It falls."}]},
    {"objectives": [{"claim": "It is pretty.", "visual_only": "taste"}]},
    {"objectives": [{"claim": "It falls.", "expect": [{"falls": {}, "moves": {}}]}]},
)
EVIDENCE = Argued("a claim without a measurement is neither true nor false of any run")


def check(view: PlanView) -> Iterator[Problem]:
    """Check each objective; then whether anything at all is measured; then the form of the expectations."""
    for index, objective in enumerate(view.plan.objectives):
        if not objective.expect and not objective.visual_only:
            message = f'nothing could prove "{objective.claim[:80]}"'
            yield view.at(("objectives", index), message, "add `expect:` with measurements, or `visual_only: why`")
        for number, row in enumerate(objective.expect):
            if len(row) != 1:
                message = f"an expectation is one name with its arguments, this one has {len(row)} names"
                yield view.at(("objectives", index, "expect", number), message, "write `- falls: {body: crate}`")
    if not any(objective.expect for objective in view.plan.objectives):
        message = "no objective is measured: the plan would be accepted on looks alone"
        yield view.at(("objectives",), message, "add an expectation, at least that what should stand still stays")
