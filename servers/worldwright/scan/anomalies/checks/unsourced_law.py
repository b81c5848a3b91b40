"""A declared intervention says neither its law nor where its constants come from.

What it means: a number without a source may have been fitted until the outcome looked right. The reader of the report
can only judge an idealisation whose law and constants are stated.

Formula: `law` or `source` of a declared intervention is blank, or says only that it was tuned.
Threshold: none. Blocking.
Source: the facts on staging (constants without unit or source).
"""

import re
from collections.abc import Iterator

from ....model.plan.committed import Intervention
from ....model.recording.trajectory import Trajectory
from ...known import analytic
from ..sign import Case, Context, Sign

CODE = "WS309"
STAGING = True
NEEDS = ("t",)
EMPTY = re.compile(r"^\W*(none|unknown|n/?a|tbd|todo|tuned|trial and error|chosen|assumed|\W*)\W*$", re.IGNORECASE)


def check(trajectory: Trajectory, context: Context) -> Iterator[Sign]:
    """Yield each intervention without a law or a source."""
    for row in context.interventions:
        for what, text in (("law", row.law), ("source", row.source)):
            if EMPTY.match(text):
                name = ", ".join(row.bodies) or "world"
                message = f"the declared {row.kind} on {name} has no {what}" + (f" ('{text}')" if text.strip() else "")
                window = (trajectory.t[0], trajectory.t[-1])
                yield Sign(name, window, 0.0, 1.0, "statements", "blocking", message)


def _declared(**fields: str) -> Context:
    given = {"law": "F = 5 N along +x", "source": "the prompt", "trigger": "always", **fields}
    return Context(planned=True, interventions=(Intervention(kind="force", bodies=("body",), **given),))


GOOD = (lambda: Case("a law with its source", analytic.resting(), _declared()),)
BAD = (
    lambda: Case("no source", analytic.resting(), _declared(source=" "), severity="blocking"),
    lambda: Case("tuned", analytic.resting(), _declared(source="tuned"), severity="blocking"),
    lambda: Case("no law", analytic.resting(), _declared(law=""), severity="blocking"),
)
