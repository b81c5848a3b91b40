"""A camera of the plan is not in the program.

What it does: compares the cameras of the plan's steps with those the program, or a file beside it, adds (`cameras.add`, `add_camera`, MJCF).

Why is this bad: stills and videos are made per camera; without it the step it belongs to is never seen, and the review
lacks a witness.

Use instead: `cameras.add(spec, "NAME", view=…, subjects=(…))` for every camera of the plan.
"""

from collections.abc import Iterator

from ... import stated
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL124"
SEVERITY = "error"
SCOPE = "plan"
HEAD = "from worldkit import cameras\nspec = None\n"
GOOD = (
    HEAD + "cameras.add(spec, 'perspective', view='perspective')\ncameras.add(spec, name='side_minus_y')\n",
    HEAD + "for name in ('perspective', 'side_minus_y'):\n    cameras.add(spec, name, view=name)\n",
)
BAD = (
    HEAD + "cameras.add(spec, 'perspective', view='perspective')\n",
    HEAD + "cameras.add(spec, 'side', view='side_minus_y')\ncameras.add(spec, 'perspective')\n",
    "spec = None\n",
)
EVIDENCE = Argued("no run shows an absence; what the camera should have shown cannot be reviewed")


def check(program: Program) -> Iterator[Problem]:
    """Check every camera of the plan."""
    if program.plan is None:
        return
    added = stated.named(program, "camera", "worldkit.cameras.add")
    for call in program.method_calls("add_camera"):
        name = program.value(program.argument(call, "name"))
        if isinstance(name, str) and added is not None:
            added.add(name)
    if added is None:  # names are made in a loop, so any string may be one
        added = program.strings
    for camera in program.plan.cameras():
        if camera.name not in added and not program.beside(camera.name):
            place = getattr(program.build, "lineno", 1)
            fix = f'add cameras.add(spec, "{camera.name}", …)'
            yield Problem(f"the plan's camera `{camera.name}` is not in the program", fix, place)
