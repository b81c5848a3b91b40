"""An `effect` names expectations that hold from the first instant on, or that the objective does not have.

What it does: looks for the expectations that `effect` names among those of the objective, and whether one of them can come
true in the course of the recording.

Why is this bad: the causal audit weakens the cause and asks whether the effect comes at another moment. What holds all the
time ("stays within", "keeps its axis") has none: only its measured number can answer, and a number may saturate
(WS322). An expectation that the objective does not have is not asked; others are taken for the effect instead.

Use instead: an expectation that is false at first and then true (`falls`, `crosses`, `tips_over`, `happens_at` …), alone
or beside the others; without `effect`, all count that do not mention the cause.
"""

from collections.abc import Iterator
from typing import Any

from ...case import Changes
from ...expectation_names import marked, vocabulary
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP128"
SEVERITY = "warning"
FALLS = {"falls": {"body": "crate", "min_m": 0.2}}
ABOVE = {"stays_within": {"body": "crate", "low": [None, None, 0.0], "high": [None, None, 2.0]}}
CLAIM = {"claim": "Its weight brings it down.", "cause": "gravity", "expect": [FALLS, ABOVE]}
GOOD: Changes = (
    {"objectives": [CLAIM]},
    {"objectives": [{**CLAIM, "effect": "falls"}]},
    {"objectives": [{**CLAIM, "effect": ["falls", "stays_within"]}]},
    {"objectives": [{**CLAIM, "effect": "the crate turns and lies on the floor"}]},
)
BAD: Changes = (
    {"objectives": [{**CLAIM, "effect": "stays_within"}]},
    {"objectives": [{**CLAIM, "effect": "tips_over"}]},
    {"objectives": [{**CLAIM, "effect": ["falls", "tips_over"]}]},
)
EVIDENCE = Argued("the audit would compare a number that may not move, or another expectation than was meant")


def check(view: PlanView) -> Iterator[Problem]:
    """Check each objective with a cause whose effect names expectations."""
    known, lasting = vocabulary(), marked("LASTING")
    for index, objective in enumerate(view.plan.objectives):
        own = {name: arguments for row in objective.expect for name, arguments in row.items()}
        words = objective.effect.replace(",", " ").split()
        named = words if set(words) <= {*known} else [word for word in words if word in own]  # else a sentence
        if not named or not objective.cause:
            continue
        place = ("objectives", index, "effect")
        for name in named:
            if name not in own:
                fix = f"add it to `expect`, or name one of its own: {', '.join(own) or 'it has none'}"
                yield view.at(place, f"the effect `{name}` is none of the objective's expectations", fix)
        if all(name in own and name in lasting and _throughout(own[name]) for name in named):
            others = [name for name in own if name not in lasting]
            fix = (
                f"name {' or '.join(others)} too" if others else "add one that comes true: falls, crosses, happens_at …"
            )
            told = ", ".join(f"`{name}`" for name in named)
            yield view.at(
                place, f"the effect {told} holds from the first instant on: it has no moment that could move", fix
            )


def _throughout(arguments: Any) -> bool:
    """Whether an expectation speaks of the whole time, not only of the time after some instant."""
    window = arguments.get("window_s") if isinstance(arguments, dict) else None
    return not (isinstance(window, list | tuple) and window and window[0] != 0)
