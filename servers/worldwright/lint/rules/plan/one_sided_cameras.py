"""A step is not seen from two or three complementary directions.

What it does: counts each step's cameras and compares their views.

Why is this bad: one picture hides depth: a ball beside a bowl looks as if it lay in it. Gaps, overlaps and floating
objects are seen from the second direction. More than three repeat each other and cost a video each.

Use instead: two or three cameras per step whose views differ, e.g. `perspective` and `side_minus_y`; add `close_up`
where a contact matters.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import Place, PlanView
from ...problem import Problem

CODE = "WP106"
SEVERITY = "warning"
STEP = {"description": "Build.", "scene_objects": ["ramp", "crate"], "assets": ["mug"]}
GOOD: Changes = (
    {},
    {
        "implementation_steps": [
            {**STEP, "cameras": [{"name": "a", "view": "top_down"}, {"name": "b", "position": [1, 1, 1]}]}
        ]
    },
    {"recording_mode": {"mode": "none"}, "implementation_steps": [STEP]},
)
BAD: Changes = (
    {"implementation_steps": [STEP]},
    {"implementation_steps": [{**STEP, "cameras": ["perspective"]}]},
    {
        "implementation_steps": [
            {**STEP, "cameras": [{"name": "a", "view": "top_down"}, {"name": "b", "view": "top_down"}]}
        ]
    },
    {"implementation_steps": []},
)
EVIDENCE = Argued("depth and what hides behind are judged by eyes, not by the engine")


def check(view: PlanView) -> Iterator[Problem]:
    """Check the plan as a whole (an error without any camera), then each step."""
    plan = view.plan
    if plan.recording_mode.mode == "none":
        return
    if not plan.cameras():
        place: Place = ("implementation_steps",)
        yield view.at(place, "no step has a camera, so nothing can be filmed", "add two cameras to a step", "error")
        return
    for index, step in enumerate(plan.implementation_steps):
        place = ("implementation_steps", index, "cameras")
        if not 2 <= len(step.cameras) <= 3:
            message = f"the step has {len(step.cameras)} camera{'s' * (len(step.cameras) != 1)}"
            yield view.at(place, message, "give it two or three, from complementary directions")
        views = [c if isinstance(c, str) else (c.view, c.subjects, c.position) for c in step.cameras]
        if len(views) > 1 and len(set(views)) == 1:
            yield view.at(place, "the step's cameras all look the same way", "let their views differ")
