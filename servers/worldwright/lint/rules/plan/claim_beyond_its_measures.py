"""A claim says a number that nothing measured for it has anything to do with.

What it does: looks for quantities in the words of a claim (figures with a point or a comma, powers of ten, number words; SI units and
the usual others, spelled or as symbols; no angles and shares), and for each a number near it (a quarter to either side) and of its
dimension among the arguments of its expectations, or among the plan's own numbers: its constants, its times, and the rows of the bodies
that are measured (of those that the claim only names, no lengths).

Why is this bad: what is proved are the expectations, what people read is the claim. "It slides 6 km", measured by
`moves: {min_m: 0.3}`, would be stamped as proved.

Use instead: the same number in both.
"""

import re
from collections.abc import Collection, Iterator
from typing import Any

from ....model.plan.in_view import alike, mentioned
from ...case import Changes
from ...harm import Argued
from ...measured_dimensions import numbers
from ...plan_view import PlanView
from ...problem import Problem
from ...spoken_quantities import Dimension, M, Quantity, S, quantities

CODE = "WP132"
SEVERITY = "error"
NEAR = 1.25


def _claim(words: str, **expectation: Any) -> dict[str, Any]:
    return {"objectives": [{"claim": words, "expect": [expectation]}]}


GOOD: Changes = (
    _claim("The crate slides 0.3 m.", moves={"body": "crate", "min_m": 0.28}),
    _claim("It slides 30 cm within 2 s.", moves={"body": "crate", "min_m": 0.3, "window_s": [0, 2]}),
    _claim("The crate slides along the ramp.", moves={"body": "crate", "min_m": 0.3}),
    _claim("It slides 28 centimetres, 0,28 m, a foot at most.", moves={"body": "crate", "min_m": 0.28}),
    _claim("The mug of 350 grams falls three tenths of a metre.", falls={"body": "mug", "min_m": 0.3}),
    _claim("The crate slides beside the mug of 0.35 kg.", moves={"body": "crate", "min_m": 0.28}),
    _claim("It swings at 2 Hz.", has_period={"body": "crate", "period_s": 0.5}),
    _claim("A second crate, on its two feet, leans by 45 degrees.", moves={"body": "crate", "min_m": 0.28}),
    {"objectives": [{"claim": "It looks 6 km long.", "visual_only": "no body is that long"}]},
)
BAD: Changes = (
    _claim("The crate slides 6 km.", moves={"body": "crate", "min_m": 0.3}),
    *(
        _claim(f"The crate slides about {far}.", moves={"body": "crate", "min_m": 0.28})
        for far in (
            "60 centimetres",
            "600 millimetres",
            "0,6 m",
            "6e-1 m",
            "60 feet",
            "two thirds of a metre",
            "0.6 m/s² far",
            "1 000 m",
        )
    ),
    _claim("The crate slides at 900 °C.", moves={"body": "crate", "min_m": 0.28}),
    {
        **_claim("The crate slides 5 m.", moves={"body": "crate", "min_m": 0.28}),
        "simulation_parameters": {"masses": {"crate": 5.0}},
    },
    _claim("The crate slides 2 m.", moves={"body": "crate", "min_m": 0.28}),
    _claim("After 40 seconds it stops.", comes_to_rest={"body": "crate"}),
)
EVIDENCE = Argued("a run shows what is measured; that the words say more, only reading them tells")


def check(view: PlanView) -> Iterator[Problem]:
    """Check claim by claim, where something is measured for it."""
    plan, rows = view.plan, alike(view.plan)
    objects = {row.name: row.model_dump() for row in plan.scene_objects}
    parameters = plan.simulation_parameters.model_dump()
    for index, objective in enumerate(plan.objectives):
        if not objective.expect:
            continue
        words = [*quantities(objective.claim)]
        measured = mentioned([dict(row) for row in objective.expect])
        measured |= {rows[name] for name in measured & rows.keys()}
        spoken = f"_{'_'.join(re.findall('[a-z0-9]+', objective.claim.lower()))}_"
        named = {name for name in rows if f"_{name.lower()}_" in spoken}
        given = [
            *numbers([dict(row) for row in objective.expect]),
            *numbers(parameters, rows.keys() - measured),
            *numbers([row for name, row in objects.items() if name in measured]),
        ]
        own = [*numbers(parameters, rows.keys() - named), *numbers([objects[name] for name in named & objects.keys()])]
        given += [(number, dimension) for number, dimension in own if dimension not in (None, M)]
        for quantity in words:
            if quantity.meant[0][0] and not _near(quantity, given):
                what = f"the claim says {quantity.said}, and nothing measured for it has to do with that"
                yield view.at(
                    ("objectives", index, "claim"),
                    what,
                    "put the number into an expectation, or take it out of the claim",
                )


def _near(quantity: Quantity, given: Collection[tuple[float, Dimension | None]]) -> bool:
    """Whether any number given is near what a quantity may mean, and of its dimension; a frequency may be given as a period."""
    meant = [
        *quantity.meant,
        *((1 / value, S) for value, dimension in quantity.meant if value and dimension == (0, 0, -1, 0, 0)),
    ]
    return any(
        value / NEAR <= abs(number) <= value * NEAR and own in (None, dimension)
        for value, dimension in meant
        for number, own in given
    )
