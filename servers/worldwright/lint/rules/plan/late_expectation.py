"""An expectation looks at a time the simulation never reaches.

What it does: compares `window_s`, `before_s`, `after_s` and `at_s` of every expectation with the duration.

Why is this bad: it can only be judged on a part of what it asks for, or on nothing at all.

Use instead: times within the duration, or a longer duration.
"""

from collections.abc import Iterator
from typing import Any

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP105"
SEVERITY = "error"
GOOD: Changes = (
    {},
    {"objectives": [{"claim": "Rest.", "expect": [{"comes_to_rest": {"body": "crate", "before_s": 2.9}}]}]},
)
BAD: Changes = (
    {"objectives": [{"claim": "Rest.", "expect": [{"comes_to_rest": {"body": "crate", "before_s": 4.0}}]}]},
    {"objectives": [{"claim": "Fall.", "expect": [{"falls": {"body": "crate", "window_s": [2.0, 5.0]}}]}]},
    {"objectives": [{"claim": "Fall.", "expect": [{"falls": {"body": "crate", "window_s": [2.0, 1.0]}}]}]},
)
EVIDENCE = Argued("the recording ends before; what is not recorded cannot be shown to hold or to fail")


def check(view: PlanView) -> Iterator[Problem]:
    """Check every time an expectation names."""
    duration = view.plan.simulation_parameters.simulation_duration
    if isinstance(duration, str):
        return
    for index, objective in enumerate(view.plan.objectives):
        for number, row in enumerate(objective.expect):
            for name, arguments in row.items():
                place = ("objectives", index, "expect", number)
                for key, times in _times(arguments):
                    late = [t for t in times if t > duration * (1 + 1e-9)]
                    if late:
                        message = f"`{name}` looks at {late[-1]:g} s, the simulation ends at {duration:g} s"
                        yield view.at(place, message, f"keep {key} within the duration")
                    elif len(times) == 2 and times[0] >= times[1]:
                        yield view.at(place, f"`{name}` has a window that ends before it starts", "write [start, end]")


def _times(arguments: Any) -> Iterator[tuple[str, list[float]]]:
    for key in ("window_s", "before_s", "after_s", "at_s", "from_s", "until_s"):
        value = arguments.get(key) if isinstance(arguments, dict) else None
        values = value if isinstance(value, list | tuple) else [value]
        if values and all(isinstance(v, int | float) and not isinstance(v, bool) for v in values):
            yield key, [float(v) for v in values if v is not None]
