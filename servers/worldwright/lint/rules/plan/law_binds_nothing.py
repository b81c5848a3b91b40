"""An intervention's law has no number, so that anything would be within it.

What it does: finds forces, torques, velocities, poses and laws of the author's own (`solver` with a `file`) whose law holds no
number and names no constant of the plan.

Why is this bad: what acts is held to the numbers of its law. "pushes the crate" is kept by one newton and by a thousand, and
a reader of the stamp cannot tell which it was.

Use instead: the magnitude in its unit (`at most 5 N along +X`, `0.3 m/s`), or the constant that holds it
(`constants.pull along +X`).
"""

import re
from collections.abc import Iterator

from ....model.plan import law_words
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP131"
SEVERITY = "error"
KINDS = ("force", "torque", "velocity", "pose")
DIGIT = re.compile(r"\d")


def _law(law: str, kind: str = "force") -> dict[str, object]:
    row = {"kind": kind, "bodies": ["crate"], "law": law, "source": "catalogue of the winch"}
    pull = {"pull": {"value": 3, "unit": "N", "source": "catalogue of the winch"}}
    return {"simulation_parameters": {"interventions": [row], "constants": pull}}


def _own(law: str) -> dict[str, object]:
    solver = {"name": "rubber", "file": "laws/rubber.py", "shown_by": "band"}
    row = {"kind": "solver", "bodies": ["crate"], "law": law, "source": "catalogue of the band", "solver": solver}
    return {"simulation_parameters": {"interventions": [row]}}


GOOD: Changes = (
    _law("at most 5 N along +X"),
    _law("the pull, along +X"),
    _law("held fast by the clamp", "constraint"),
    _own("a band of 200 N/m, at most 5 N"),
)
BAD: Changes = (
    _law("pushes the crate"),
    _law("set to what it needs", "velocity"),
    _law("laid where it belongs", "pose"),
    _own("pulls the crate as rubber does"),
)
EVIDENCE = Argued("a law without a number is kept by any force, so that no run can break it")


def check(view: PlanView) -> Iterator[Problem]:
    """Check row by row."""
    parameters = view.plan.simulation_parameters
    for index, row in enumerate(parameters.interventions):
        own = row.solver is not None and bool(row.solver.file)
        if (
            (own or row.kind in KINDS)
            and not DIGIT.search(row.law)
            and not law_words.named(row.law, parameters.constants)
        ):
            what = f"the law of the {row.kind} on {', '.join(row.bodies)} states no magnitude: `{row.law}`"
            place = ("simulation_parameters", "interventions", index, "law")
            yield view.at(place, what, "say how much at most, in its unit, or name the constant that says it")
