"""An object belongs to no implementation step.

What it does: compares the objects of the plan with what the steps say they build.

Why is this bad: whoever builds by the steps leaves it out, or adds it without a camera to review it by.

Use instead: name it under `scene_objects` or `assets` of the step that builds it.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP120"
SEVERITY = "warning"
STEP = {"description": "Build.", "cameras": ["perspective", "side_minus_y"]}
GOOD: Changes = ({}, {"implementation_steps": [{**STEP, "scene_objects": ["ramp", "crate"], "assets": ["mug"]}]})
BAD: Changes = (
    {"implementation_steps": [{**STEP, "scene_objects": ["ramp", "crate"]}]},
    {"implementation_steps": [{**STEP, "assets": ["mug"], "motion_expectations": ["crate"]}]},
)
EVIDENCE = Argued("what is left out of the steps is left out by a builder, not by the engine")


def check(view: PlanView) -> Iterator[Problem]:
    """Check scene objects and asset rows; a row counts when one of its instances is named."""
    plan = view.plan
    if not plan.implementation_steps:
        return
    built = {name for step in plan.implementation_steps for name in (*step.scene_objects, *step.assets)}
    fix = "name it in the step that builds it"
    for index, row in enumerate(plan.scene_objects):
        if row.name not in built and not row.built:
            yield view.at(("scene_objects", index), f"no step builds {row.name}", fix)
    for index, asset in enumerate(plan.assets):
        if not built & {asset.name, *asset.instances}:
            yield view.at(("assets", index), f"no step builds {asset.name}", fix)
