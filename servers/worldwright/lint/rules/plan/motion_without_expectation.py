"""An object is expected to move, but nothing measures it.

What it does: compares the steps' `motion_expectations` with the bodies named by expectations. Movers that joints join to one that
is named count with it.

Why is this bad: the claim that it moves rests on somebody's eyes alone; if it stays, nothing fails.

Use instead: an expectation that names it: `moves`, `falls`, `reaches_speed`, `bounces`, `comes_to_rest` …
"""

from collections.abc import Iterator
from fnmatch import fnmatchcase
from typing import Any

from ...case import Changes
from ...expectation_names import marked
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP111"
SEVERITY = "warning"
GOOD: Changes = (
    {},
    {"objectives": [{"claim": "All rest.", "expect": [{"comes_to_rest": {"bodies": ["crate", "mug"]}}]}]},
)
CHAIN = {
    "implementation_steps": [
        {"description": "b", "cameras": ["top_down", "perspective"], "motion_expectations": ["crate", "mug"]}
    ],
    "topology": {"joints": [{"name": "hinge", "type": "hinge", "parent": "crate", "child": "mug"}]},
    "objectives": [{"claim": "It moves.", "expect": [{"moves": {"body": "mug", "min_m": 0.1}}]}],
}
GOOD += (CHAIN,)
BAD: Changes = (
    {"objectives": [{"claim": "It stays.", "expect": [{"stays": {"body": "mug"}}]}]},
    {
        "implementation_steps": [
            {"description": "b", "cameras": ["top_down", "perspective"], "motion_expectations": ["crate", "mug"]}
        ]
    },
)
EVIDENCE = Argued("what nobody measures cannot be shown to fail")


def check(view: PlanView) -> Iterator[Problem]:
    """Check every mover that no expectation names; an expectation without bodies speaks of all of them."""
    named: set[str] = set()
    of_the_world = marked("OF_MOVERS", value=False)
    for objective in view.plan.objectives:
        for row in objective.expect:
            for name, arguments in row.items():
                found = set(_strings(arguments))
                if not found and name not in of_the_world:
                    return
                named |= found
    broken = {name: view.plan.families[name] for name in view.plan.broken}
    families = {piece: {name, f"{name}_*", *pieces} for name, pieces in broken.items() for piece in pieces}
    movers = {mover for step in view.plan.implementation_steps for mover in step.motion_expectations}
    named |= _joined(view, named & movers, movers)
    for index, step in enumerate(view.plan.implementation_steps):
        for number, mover in enumerate(step.motion_expectations):
            described = view.rows.get(mover)
            meant = not named.isdisjoint(
                families.get(mover, ())
            )  # of what breaks: a claim about one piece is about the thing
            meant = meant or any(
                fnmatchcase(mover, name) for name in named
            )  # a crowd may be named by a pattern, `grain_*`
            if not meant and (described is None or described.name not in named):
                place = ("implementation_steps", index, "motion_expectations", number)
                yield view.at(
                    place, f"nothing measures that `{mover}` moves", f"expect e.g. `- moves: {{body: {mover}}}`"
                )


def _joined(view: PlanView, named: set[str], movers: set[str]) -> set[str]:
    """Movers that joints join to named ones, over other movers; what does not move, such as a door's frame, joins nothing."""
    found, waiting = set(named), list(named)
    joints = [(joint.parent, joint.child) for joint in view.plan.topology.joints]
    while waiting:
        one = waiting.pop()
        near = {b if a == one else a for a, b in joints if one in (a, b)} & movers - found
        found |= near
        waiting += near
    return found


def _strings(value: Any) -> Iterator[str]:
    if isinstance(value, str):
        yield value
    elif isinstance(value, dict):
        for item in value.values():
            yield from _strings(item)
    elif isinstance(value, list | tuple):
        for item in value:
            yield from _strings(item)
