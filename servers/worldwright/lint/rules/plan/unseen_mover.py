"""What should move is in no camera's picture.

What it does: compares the objects under `motion_expectations`, and what they are placed on or in or welded to, with the
`subjects` of all cameras; a camera without subjects frames everything that moves.

Why is this bad: the motion is claimed and measured, and nobody can see it: the review has nothing to look at.

Use instead: the object among the subjects of at least one camera.
"""

from collections.abc import Iterator

from ...case import Changes
from ...harm import Argued
from ...plan_view import PlanView
from ...problem import Problem

CODE = "WP125"
SEVERITY = "warning"
STEP = {
    "description": "Build.",
    "scene_objects": ["ramp", "crate"],
    "assets": ["mug"],
    "motion_expectations": ["crate"],
}


def _seen(*subjects: str) -> dict:
    rows = [{"name": n, "view": v, "subjects": list(subjects)} for n, v in (("a", "perspective"), ("b", "top_down"))]
    return {"implementation_steps": [{**STEP, "cameras": rows}]}


GOOD: Changes = (
    _seen("crate"),
    _seen("ramp"),
    _seen(),
    {**_seen("mug"), "topology": {"joints": [{"name": "glue", "type": "weld", "parent": "crate", "child": "mug"}]}},
)
BAD: Changes = (_seen("mug"),)
EVIDENCE = Argued("what a picture shows is judged by eyes; the world moves all the same")


def check(view: PlanView) -> Iterator[Problem]:
    """Check movers of the whole plan against cameras of the whole plan."""
    cameras = view.plan.cameras()
    if (
        not cameras
        or view.plan.recording_mode.mode == "none"
        or any(not c.subjects and c.target is None for c in cameras)
    ):
        return
    if any(c.position is not None for c in cameras):  # the layout decides what a camera with a pose of its own sees
        return
    seen = {name for camera in cameras for name in camera.subjects}
    supports: dict[str, set[str]] = {}
    for row in view.plan.topology.scene_predicates:
        for name in view.plan.families.get(row.subject, (row.subject,)) if row.object else ():
            supports.setdefault(name, set()).add(str(row.object))
    for joint in view.plan.topology.joints:
        if joint.type == "weld":  # one body: a camera that sees it sees its parts
            supports.setdefault(joint.child, set()).add(joint.parent)
            supports.setdefault(joint.parent, set()).add(joint.child)
    for index, step in enumerate(view.plan.implementation_steps):
        for name in step.motion_expectations:
            if not _chain(name, supports) & seen:
                place = ("implementation_steps", index, "motion_expectations")
                yield view.at(place, f"no camera looks at {name}", "name it among a camera's subjects")


def _chain(name: str, supports: dict[str, set[str]]) -> set[str]:
    """An object and everything that it stands on, in or is welded to, directly or not."""
    found, waiting = set(), [name]
    while waiting:
        current = waiting.pop()
        if current not in found:
            found.add(current)
            waiting += supports.get(current, ())
    return found
