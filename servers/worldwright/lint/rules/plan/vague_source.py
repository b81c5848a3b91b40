"""A source says that there is none.

What it does: finds sources such as "assumed", "typical value", "common knowledge", "estimate" alone, of materials,
constants and interventions.

Why is this bad: a constant that was chosen so that the outcome fits looks the same as one that was measured.

Use instead: a table, a standard, a data sheet, a textbook; what is really chosen is listed under `inferred`, for the user
to audit.
"""

import re
from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP123"
SEVERITY = "warning"


def _wood(source: str) -> dict:
    return {"simulation_parameters": {"materials": {"wood": {"density": 700, "source": source}}}}


GOOD: Changes = (_wood("typical values in the CRC Handbook, 0.6-0.8 g/cm^3"), {})
BAD: Changes = (_wood("assumed"), _wood("Typical value."), _wood("common knowledge"), _wood("tuned to look right"))
EVIDENCE = Argued("any constant simulates; whether it is right, only its source tells")
VAGUE = re.compile(
    r"(?:an?\s+)?(?:assum\w*|typical(?:\s+values?)?|estimat\w*|guess\w*|common(?:\s+knowledge)?|default\w*|chosen|none|n/?a|"
    r"unknown|tbd|todo|physics|standard(?:\s+values?)?|reasonable(?:\s+values?)?|tuned\b.*|my own\b.*|llm|ai)[\s.!]*",
    re.IGNORECASE,
)


def check(view: PlanView) -> Iterator[Problem]:
    """Check sources of materials, constants, interventions; what is listed as inferred is open already."""
    parameters, section = view.plan.simulation_parameters, "simulation_parameters"
    rows: list[tuple[Place, str, str]] = [
        *(((section, "materials", n), f"materials.{n}", row.source) for n, row in parameters.materials.items()),
        *(((section, "constants", n), f"constants.{n}", row.source) for n, row in parameters.constants.items()),
        *(
            ((section, "interventions", i), f"interventions.{i}", r.source)
            for i, r in enumerate(parameters.interventions)
        ),
    ]
    for place, name, source in rows:
        open_already = any(entry.removeprefix(f"{section}.").startswith(name) for entry in parameters.inferred)
        if source.strip() and VAGUE.fullmatch(source.strip()) and not open_already:
            yield view.at(
                (*place, "source"), f"`{source.strip()}` is no source", "name the table, standard or data sheet"
            )
