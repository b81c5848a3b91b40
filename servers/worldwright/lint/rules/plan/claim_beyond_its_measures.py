"""A claim says a number that nothing measured for it has anything to do with.

What it does: looks for lengths, speeds, times, masses and forces in the words of a claim, and for each a number near it
(a quarter to either side) among the arguments of its expectations or among the plan's own numbers.

Why is this bad: what is proved are the expectations, what people read is the claim. "It slides 6 km", measured by
`moves: {min_m: 0.3}`, would be stamped as proved.

Use instead: the same number in both.
"""

import re
from collections.abc import Iterator
from typing import Any

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP132"
SEVERITY = "error"
SCALE = {
    "km": 1e3, "m": 1.0, "metres": 1.0, "meters": 1.0, "metre": 1.0, "meter": 1.0, "cm": 1e-2, "mm": 1e-3,
    "m/s": 1.0, "km/h": 1 / 3.6, "s": 1.0, "seconds": 1.0, "second": 1.0, "ms": 1e-3, "minutes": 60.0,
    "kg": 1.0, "g": 1e-3, "n": 1.0, "kn": 1e3,
}  # fmt: skip
NUMBER = re.compile(
    rf"(?<![\w.])(\d+(?:\.\d+)?)\s?({'|'.join(sorted(map(re.escape, SCALE), key=len, reverse=True))})(?![\w/·*^²])",
    re.IGNORECASE,
)
NEAR = 1.25


def _claim(words: str, **expectation: Any) -> dict[str, Any]:
    return {"objectives": [{"claim": words, "expect": [expectation]}]}


GOOD: Changes = (
    _claim("The crate slides 0.3 m.", moves={"body": "crate", "min_m": 0.28}),
    _claim("It slides 30 cm within 2 s.", moves={"body": "crate", "min_m": 0.3, "window_s": [0, 2]}),
    _claim("The crate slides along the ramp.", moves={"body": "crate", "min_m": 0.3}),
    {"objectives": [{"claim": "It looks 6 km long.", "visual_only": "no body is that long"}]},
)
BAD: Changes = (
    _claim("The crate slides 6 km.", moves={"body": "crate", "min_m": 0.3}),
    _claim("After 40 seconds it stops.", comes_to_rest={"body": "crate"}),
)
EVIDENCE = Argued("a run shows what is measured; that the words say more, only reading them tells")


def check(view: PlanView) -> Iterator[Problem]:
    """Check claim by claim, where something is measured for it."""
    plan = view.plan
    own = [
        *_numbers(plan.simulation_parameters.model_dump()),
        *_numbers([row.model_dump() for row in plan.scene_objects]),
    ]
    for index, objective in enumerate(plan.objectives):
        if not objective.expect:
            continue
        place = ("objectives", index, "claim")
        given = [*_numbers([dict(row) for row in objective.expect]), *own]
        for number, unit in NUMBER.findall(objective.claim):
            value = float(number) * SCALE[unit.lower()]
            if value and not any(value / NEAR <= abs(other) <= value * NEAR for other in given):
                what = f"the claim says {number} {unit}, and nothing measured for it has to do with that"
                yield view.at(place, what, "put the number into an expectation, or take it out of the claim")


def _numbers(value: Any) -> list[float]:
    """Every number anywhere in a value."""
    if isinstance(value, bool):
        return []
    if isinstance(value, (int, float)):
        return [float(value)]
    inner = value.values() if isinstance(value, dict) else value if isinstance(value, (list, tuple)) else ()
    return [number for item in inner for number in _numbers(item)]
