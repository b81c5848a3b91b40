"""A camera has no view, or one that does not exist.

What it does: looks at every camera row: neither a `view` nor a `position`, a view that worldkit does not know, a position
that is its own target.

Why is this bad: the camera cannot be placed, and the pass that films it fails.

Use instead: one of the named views, or `position` and `target`.
"""

from collections.abc import Iterator
from difflib import get_close_matches

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP121"
SEVERITY = "error"
STEP = {"description": "Build.", "scene_objects": ["ramp", "crate"], "assets": ["mug"]}


def _with(*cameras: object) -> dict:
    return {"implementation_steps": [{**STEP, "cameras": ["perspective", *cameras]}]}


GOOD: Changes = (
    _with({"name": "near", "view": "close_up"}),
    _with({"name": "a", "position": [1, 1, 1], "target": [0, 0, 0]}),
)
BAD: Changes = (
    _with({"name": "near"}),
    _with({"name": "near", "view": "closeup"}),
    _with("from_above"),
    _with({"name": "a", "position": [1, 1, 1], "target": [1, 1, 1]}),
)
EVIDENCE = Argued("worldkit refuses an unknown view with the known ones; its own tests run that")


def check(view: PlanView) -> Iterator[Problem]:
    """Check cameras of every step."""
    from worldkit.cameras import VIEWS

    for index, step in enumerate(view.plan.implementation_steps):
        for number, row in enumerate(step.cameras):
            place = ("implementation_steps", index, "cameras", number)
            name, wanted = (row, row) if isinstance(row, str) else (row.name, row.view)
            position, target = (None, None) if isinstance(row, str) else (row.position, row.target)
            if wanted is None and position is None:
                yield view.at(place, f"camera {name} has neither a view nor a position", "give it one of them")
            elif wanted is not None and position is None and wanted not in VIEWS:
                near = get_close_matches(wanted, list(VIEWS), n=2, cutoff=0.5)
                fix = ("did you mean " + " or ".join(near) + "? " if near else "") + "known: " + ", ".join(VIEWS)
                yield view.at(place, f"there is no view `{wanted}`", fix)
            if position is not None and position == target:
                yield view.at(place, f"camera {name} looks at where it stands", "move its target")
