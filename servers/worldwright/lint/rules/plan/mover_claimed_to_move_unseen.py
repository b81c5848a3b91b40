"""What is expected to move may hold every claim by moving less than counts as moving.

What it does: compares the least way that is claimed of each body under `motion_expectations` (`min_m` of `falls`, `moves`, `rises` …)
with 2 % of the radius of the sphere around it, below which `WS111` says after the physics that it did not move. Who turns by two
degrees counts as moving, too: a body of which a turn is claimed is not asked.

Why is this bad: the claim is proved, and the run is stopped all the same, once the physics is paid for.

Use instead: claim at least so much, or take the body out of `motion_expectations`.
"""

import math
from collections.abc import Iterator
from typing import Any

from ....model.plan.scene_objects import SceneObject
from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP134"
SEVERITY = "warning"
WAYS = ("falls", "moves", "rises", "moves_towards", "moves_straight", "travels", "slides", "slides_and_stops")
TURNS = (
    "turns",
    "tips_over",
    "reaches_spin",
    "spins_at_constant_rate",
    "precesses",
    "ends_facing",
    "joint_moves",
    "rolls_without_slipping",
)


def _claimed(**expectation: Any) -> dict[str, Any]:
    return {"objectives": [{"claim": "It moves.", "expect": [{name: given} for name, given in expectation.items()]}]}


GOOD: Changes = (
    {},
    _claimed(falls={"body": "crate", "min_m": 0.006}),
    _claimed(falls={"body": "crate", "min_m": 0.002}, moves={"body": "crate", "min_m": 0.1}),
    _claimed(falls={"body": "crate", "min_m": 0.002}, tips_over={"body": "crate"}),
)
BAD: Changes = (_claimed(falls={"body": "crate", "min_m": 0.002}), _claimed(moves={"body": "crate", "min_m": 0.005}))
EVIDENCE = Argued("whether it moves further than is claimed only the physics tells; that less would do, the plan says")


def check(view: PlanView) -> Iterator[Problem]:
    """Check each expected mover whose size and way the plan states."""
    from ....model.recording.travel import SIZE_FRACTION  # numpy, which other rules do without

    said = [(name, given) for one in view.plan.objectives for row in one.expect for name, given in row.items()]
    for index, step in enumerate(view.plan.implementation_steps):
        for number, mover in enumerate(step.motion_expectations):
            row = view.rows.get(mover)
            about = [(name, given) for name, given in said if isinstance(given, dict) and given.get("body") == mover]
            ways = [_way(given) for name, given in about if name in WAYS]
            if not isinstance(row, SceneObject) or not ways or any(name in TURNS for name, _ in about):
                continue
            least = SIZE_FRACTION * math.hypot(*row.size) / 2
            if max(ways) < least:
                place = ("implementation_steps", index, "motion_expectations", number)
                what = f"`{mover}` counts as moving from {least:.2g} m on (2 % of its radius), and {max(ways):g} m are claimed"
                yield view.at(place, what, f"claim {least:.2g} m or more, or take it out of motion_expectations")


def _way(given: dict[str, Any]) -> float:
    """The least way that is claimed, m; without end where none is told."""
    told = given.get("min_m")
    return float(told) if isinstance(told, int | float) and not isinstance(told, bool) else math.inf
