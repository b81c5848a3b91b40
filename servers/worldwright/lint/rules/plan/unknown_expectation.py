"""An expectation is not in the vocabulary, or names a body the plan does not have.

What it does: compares the names under `expect` with the entries of the expectation shelf, every `body`, `bodies`
and `support` with the plan's objects, and `camera` with its cameras.

Why is this bad: an unknown expectation is never measured, so its objective stays unproved and the run cannot be
accepted.

Use instead: a listed name; `worldwright scan expect --help` and the shelf's pages say what each measures.
"""

from collections.abc import Iterator
from difflib import get_close_matches
from typing import Any

from ....model.plan.imported import all_of
from ...case import Changes
from ...expectation_names import vocabulary
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP104"
SEVERITY = "error"
GOOD: Changes = (
    {},
    {"objectives": [{"claim": "It rests.", "expect": [{"supported_by": {"body": "crate", "support": "ramp"}}]}]},
)
BAD: Changes = (
    {"objectives": [{"claim": "It flies.", "expect": [{"flies_gracefully": {"body": "crate"}}]}]},
    {"objectives": [{"claim": "It moves.", "expect": [{"moves": {"body": "create"}}]}]},
    {"objectives": [{"claim": "They stay.", "expect": [{"stays": {"bodies": ["ramp", "mugg"]}}]}]},
    {
        "objectives": [
            {"claim": "Large.", "expect": [{"appears_as_large": {"body": "mug", "camera": "sid", "min_px": 9}}]}
        ]
    },
    {
        "objectives": [
            {"claim": "At 1 s.", "expect": [{"happens_at": {"event": {"falls": {"body": "mugg"}}, "at_s": 1}}]}
        ]
    },
)
EVIDENCE = Argued("an expectation that nothing implements is answered `unknown` by scan, whatever the run did")
BODY_KEYS = ("body", "bodies", "support", "other", "others", "by", "on", "medium")
SCENERY = ("ground", "world", "base", "floor")


def check(view: PlanView) -> Iterator[Problem]:
    """Check names, then bodies."""
    known = vocabulary()
    cameras = [row.name for row in view.plan.cameras()]
    objects = [*view.rows, *(joint.name for joint in view.plan.topology.joints), *SCENERY]
    objects += [name for _, _, model in all_of(view.plan) for name in model.names()]
    for index, objective in enumerate(view.plan.objectives):
        for number, row in enumerate(objective.expect):
            for name, arguments in row.items():
                place = ("objectives", index, "expect", number)
                if known and name not in known:
                    near = get_close_matches(name, known, n=2, cutoff=0.5)
                    fix = (f"did you mean {' or '.join(near)}? " if near else "") + f"known: {', '.join(known)}"
                    yield view.at(place, f"there is no expectation `{name}`", fix)
                camera = arguments.get("camera") if isinstance(arguments, dict) else None
                if isinstance(camera, str) and camera not in cameras:
                    fix = f"name a camera of implementation_steps: {', '.join(cameras) or '(none)'}"
                    yield view.at(place, f"`{name}` looks through `{camera}`, which the plan does not have", fix)
                for body in _bodies(arguments):
                    if body not in objects:
                        near = get_close_matches(body, objects, n=2, cutoff=0.5)
                        fix = f"did you mean {' or '.join(near)}?" if near else "name an object of the plan"
                        yield view.at(place, f"`{name}` names `{body}`, which the plan does not have", fix)


def _bodies(arguments: Any) -> Iterator[str]:
    if isinstance(arguments, list | tuple):
        for item in arguments:
            yield from _bodies(item)
    if not isinstance(arguments, dict):
        return
    for key, value in arguments.items():
        if key in BODY_KEYS:
            yield from (
                item for item in (value if isinstance(value, list | tuple) else [value]) if isinstance(item, str)
            )
        else:  # an event is an expectation in the arguments of another
            yield from _bodies(value)
