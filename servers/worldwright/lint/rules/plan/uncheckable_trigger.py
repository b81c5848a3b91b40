"""An intervention's trigger is a condition that nothing can check.

What it does: reads the triggers of constraints and other interventions that state a condition (`when`, `if`, `once`, `>`,
`exceeds` …), and tries the form that scan can compare with the recording: `load > 400 N`, `stress > 45 MPa` (of bonds), `tension
of rope > 30 N`, `contact force on plate > 50 N`, `speed of cart > 2 m/s`, `height of ball < 0.1 m`.

Why is this bad: a fastener that lets go at a moment of the author's choosing looks like one that broke. Only a threshold
in a recorded quantity can tell them apart.

Use instead: a quantity, a sign, a number and a unit; a command given at a time says so: `at t = 1.0 s`.
"""

import re
from collections.abc import Iterator

from ....model.finding import Severity
from ....model.plan.trigger import threshold, touching
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP116"
SEVERITY = "warning"
BOLT = {"kind": "constraint", "bodies": ["crate"], "law": "the bolt breaks", "source": "ISO 898-1, class 4.6"}


def _with(trigger: str) -> dict[str, object]:
    return {"simulation_parameters": {"interventions": [{**BOLT, "trigger": trigger}]}}


GOOD: Changes = (
    _with("load > 400 N"),
    _with("stress > 45 MPa"),
    _with("at t = 1.0 s"),
    _with("always"),
    _with("speed of crate exceeds 2 m/s"),
    _with("while crate touches ramp"),
)
BAD: Changes = (
    _with("when it is too heavy"),
    _with("stress > yield"),
    _with("if the load gets high"),
    _with("while it is warm"),
)
EVIDENCE = Argued(
    "what the words mean decides when it should have happened; scan cannot compare words with a recording"
)
PUSHES = ("force", "torque", "velocity", "pose")
"""Kinds that can bring about anything by themselves: they must be seen to have waited."""
CONDITION = re.compile(
    r"[<>]|\b(?:when|while|if|once|until|exceeds?|above|below|over|under|breaks?|reaches)\b", re.IGNORECASE
)
TIME = re.compile(r"\b(?:t|time)\s*(?:=|>=?|<=?|is)\s*\d|\bat\s+\d|\bafter\s+\d", re.IGNORECASE)


def check(view: PlanView) -> Iterator[Problem]:
    """Check every trigger that is a condition and not a time."""
    for index, item in enumerate(view.plan.simulation_parameters.interventions):
        if CONDITION.search(item.trigger) and not TIME.search(item.trigger) and threshold(item.trigger) is None:
            if touching(item.trigger) is not None:
                continue
            place = ("simulation_parameters", "interventions", index, "trigger")
            fix = "write a quantity, a sign, a number and a unit, e.g. `load > 400 N`, or `while A touches B`"
            severity: Severity = "error" if item.kind in PUSHES else "warning"
            yield view.at(place, f"the trigger `{item.trigger}` cannot be checked", fix, severity)
