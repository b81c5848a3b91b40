"""The plan makes no world to compare with.

What it does: says why the plan's own draft could not be compiled, so that nothing of what acts in the program's world was
held against it; and whether that is the plan's fault, or this machine lacks what making it takes.

Why is this bad: nobody approved what the plan cannot say, and a world that is compared with nothing can be anything.

Use instead: what the message names; `worldwright place check` and `worldwright stage draft` show the same.
"""

from collections.abc import Iterator

from ....compiled.view import ModelView
from ....harm import Argued
from ....problem import Problem
from ._twins import PLAN, SOUND, changed

CODE = "WM171"
SEVERITY = "error"
SCOPE = "acts"
NO_TWIN = True
GOOD = SOUND
BAD = ((changed()[0], PLAN | {"topology": {"scene_predicates": None}}),)
EVIDENCE = Argued("a comparison that is not made shows nothing, of any world")


def check(view: ModelView) -> Iterator[Problem]:
    """Check the outcome of the plan's draft."""
    planned = view.planned
    if planned is not None and planned.outcome.status != "compiled":
        if lacked := planned.outcome.lacked:
            said = "what acts could not be held against the plan, whose world this machine could not make"
            yield Problem(f"{said}: {lacked[0]}", lacked[1], 1)
            return
        why = " ".join((planned.outcome.message or planned.outcome.status).split())[:300]
        yield Problem(
            f"what acts could not be held against the plan, which makes no world: {why}", "correct the plan", 1
        )
