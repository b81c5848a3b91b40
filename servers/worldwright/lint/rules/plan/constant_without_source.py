"""A physical constant does not say where it comes from.

What it does: reports materials and constants with an empty `source`, unless the value is listed as inferred.

Why is this bad: constants are how an outcome can be tuned into being. A source lets a reader tell a property of oak
from a number that made the picture right.

Use instead: a table, a standard, a data sheet, a textbook; or list the value's dotted name under `inferred`, for the
user to audit.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP113"
SEVERITY = "warning"
GOOD: Changes = (
    {},
    {"simulation_parameters": {"materials": {"wood": {"density": 700, "source": ""}}, "inferred": ["materials.wood"]}},
)
BAD: Changes = (
    {"simulation_parameters": {"materials": {"wood": {"density": 700, "source": " "}}}},
    {"simulation_parameters": {"constants": {"drag": {"value": 1.05, "unit": "1", "source": ""}}}},
    {
        "simulation_parameters": {
            "interventions": [{"kind": "force", "bodies": ["crate"], "law": "F = 3 N", "source": ""}]
        }
    },
)
EVIDENCE = Argued("any constant simulates; whether it is right, only its source tells")


def check(view: PlanView) -> Iterator[Problem]:
    """Check materials, constants, interventions."""
    parameters = view.plan.simulation_parameters
    fix = "name the table, standard or textbook, or list it under `inferred`"
    for group, rows in (("materials", parameters.materials), ("constants", parameters.constants)):
        for name, row in rows.items():
            audited = any(
                entry.removeprefix("simulation_parameters.").startswith(f"{group}.{name}")
                for entry in parameters.inferred
            )
            if not row.source.strip() and not audited:
                yield view.at(("simulation_parameters", group, name), f"{group[:-1]} `{name}` has no source", fix)
    for index, item in enumerate(parameters.interventions):
        if not item.source.strip():
            place = ("simulation_parameters", "interventions", index)
            yield view.at(place, f"the {item.kind} on {', '.join(item.bodies)} has no source", fix, severity="error")
