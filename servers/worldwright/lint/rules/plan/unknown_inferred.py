"""`inferred` lists a value that the plan does not have.

What it does: resolves every dotted name under `inferred`.

Why is this bad: the list tells the user which numbers to audit. A name that leads nowhere hides the number it was meant
for.

Use instead: the dotted path as it stands in `simulation_parameters`, or from the section on.
"""

from collections.abc import Iterator
from typing import Any

from ...case import Changes
from ...plan_view import PlanView
from ...problem import Problem
from ...proof import Argued

CODE = "WP124"
SEVERITY = "warning"
GOOD: Changes = ({"simulation_parameters": {"inferred": ["materials.wood.friction", "simulation_duration"]}}, {})
BAD: Changes = (
    {"simulation_parameters": {"inferred": ["materials.steel.friction"]}},
    {"simulation_parameters": {"inferred": ["duration"]}},
)
EVIDENCE = Argued("the list is for the user who approves the plan; no run reads it")


def check(view: PlanView) -> Iterator[Problem]:
    """Each name, in the parameters and in the whole plan."""
    whole = view.plan.model_dump()
    for index, name in enumerate(view.plan.simulation_parameters.inferred):
        parts = name.replace("[", ".").replace("]", "").split(".")
        if not any(_leads(root, parts) for root in (whole["simulation_parameters"], whole)):
            place = ("simulation_parameters", "inferred", index)
            yield view.at(
                place, f"`{name}` leads to nothing in the plan", "write its path, e.g. materials.wood.friction"
            )


def _leads(value: Any, parts: list[str]) -> bool:
    """Whether a dotted path leads somewhere; rows of a list may be named by number or by name."""
    for part in parts:
        if isinstance(value, dict) and part in value:
            value = value[part]
        elif isinstance(value, list | tuple):
            found = [
                v for i, v in enumerate(value) if str(i) == part or (isinstance(v, dict) and v.get("name") == part)
            ]
            if not found:
                return False
            value = found[0]
        else:
            return False
    return True
