"""An expectation lacks an argument, has one it does not know, or one of the wrong kind.

What it does: gives the arguments of every expectation to the module that will measure it.

Why is this bad: such an expectation cannot be measured. It would say so only after the physics had run, and its
objective would stay unproved.

Use instead: the arguments that the finding lists, in the units their names say.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP114"
SEVERITY = "error"
GOOD: Changes = (
    {},
    {"objectives": [{"claim": "It falls.", "expect": [{"falls": {"body": "crate", "min_m": 0.2}}]}]},
)
BAD: Changes = (
    {"objectives": [{"claim": "It falls.", "expect": [{"falls": {"body": "crate", "metres": 0.2}}]}]},
    {"objectives": [{"claim": "It falls.", "expect": [{"falls": {"body": "crate", "min_m": "a lot"}}]}]},
    {"objectives": [{"claim": "It touches.", "expect": [{"touches": {}}]}]},
)
EVIDENCE = Argued("scan refuses to judge it; no run changes that")


def check(view: PlanView) -> Iterator[Problem]:
    """Check each expectation of each objective."""
    from ....scan.tools import argument_problem

    for index, objective in enumerate(view.plan.objectives):
        for number, row in enumerate(objective.expect):
            for name, arguments in row.items():
                if problem := argument_problem(name, arguments):
                    message, fix = problem
                    yield view.at(("objectives", index, "expect", number), f"`{name}`: {message}", fix)
