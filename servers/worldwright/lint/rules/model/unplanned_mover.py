"""Something can move that the plan does not know.

What it does: finds free bodies of the compiled world that are neither an object of the plan nor part of one.

Why is this bad: an unplanned body can push, carry or hide what the claims are about, and no expectation looks at it.

Use instead: declare it in `scene_objects` or `assets`, or fix it to the world.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Argued
from ...problem import Problem
from ._planned import THREE

CODE = "WM158"
SEVERITY = "warning"
SCOPE = "plan"
GOOD = (THREE,)
BAD = (
    THREE[: THREE.index("<keyframe>")].replace(
        "</worldbody>", "<body name='pusher'><freejoint/><geom size='.1'/></body></worldbody>"
    )
    + "</mujoco>",
)
EVIDENCE = Argued("what an extra body does depends on the world; that nobody planned it, only the plan tells")


def check(view: ModelView) -> Iterator[Problem]:
    """Check free bodies whose name does not begin with a planned one's."""
    assert view.plan is not None
    planned = view.plan.object_names()
    flexed = {int(b) for b in view.flex_vertbodyid}
    for joint, kind in enumerate(view.joint_kind):
        body = int(view.jnt_bodyid[joint])
        name = view.texts["names"]["body"][body]
        ours = any(name == p or name.startswith((f"{p}_", f"{p}/", f"{p}.")) for p in planned)
        if kind == "free" and body not in flexed and not ours:
            message = f"{view.name('body', body)} can move, but the plan does not have it"
            yield view.at(
                "body", body, message, "declare it in the plan (`worldwright plan complete` writes it down), or fix it"
            )
