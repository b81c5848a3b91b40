"""Something the user owns is still open.

What it does: reports every `TO_CLARIFY`, in whatever value or line of the plan it stands (prose, comments and the sentence
under the title too), and every entry of `clarifications_needed`.

Why is this bad: code for an open question answers it silently. Time step and duration in particular are never
defaulted.

Use instead: ask, write the answer into the section that owns it, and remove the clarification. In auto mode choose a
conservative value and list its dotted name under `simulation_parameters.inferred`.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP101"
SEVERITY = "error"
GOOD: Changes = ({}, {"simulation_parameters": {"inferred": ["time_step"]}})
BAD: Changes = (
    {"simulation_parameters": {"time_step": "TO_CLARIFY"}},
    {"clarifications_needed": ["How heavy is the crate?"]},
    {"topology": {"body_positions": {"crate": "TO_CLARIFY"}}},
    {"geometry_relations": [{"relation_name": "TO_CLARIFY", "body_a": "crate", "body_b": "ramp"}]},
    {"topology": {"scene_predicates": [{"subject": "crate", "predicate": "TO_CLARIFY", "object": "ramp"}]}},
    {"objectives": [{"claim": "TO_CLARIFY how far it slides", "expect": [{"moves": {"body": "crate"}}]}]},
)
EVIDENCE = Argued("a number that is not there cannot be run; it would have to be invented")


def check(view: PlanView) -> Iterator[Problem]:
    """Check everything `Plan.unresolved` names: each line of the text at that line, all else at its value."""
    for section, line, text in view.plan.open_lines:
        fix = f"ask the user, then write the answer into the `{section}` and take the mark out of its text"
        yield Problem(f"{section}: `{text}` is still open", fix, line, section=section)
    for what in view.plan.open_values():
        place, _, rest = what.partition(": ")
        path = tuple(int(part) if part.isdigit() else part for part in place.split("."))
        yield view.at(path, f"{what} is still open", f"ask the user, then write the answer into `{rest or place}`")
