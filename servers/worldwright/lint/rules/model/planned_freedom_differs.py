"""What the plan fixes can move, or what it lets move is fixed.

What it does: compares `fixed` and `dynamic` of every object with the degrees of freedom of its body.

Why is this bad: a table that should stand gives way; a ball that should fall hangs in the air. A body without a joint
is welded to the world, and the engine does not say so.

Use instead: `add_freejoint()` (in worldkit: leave `fixed` false) for what moves, none for what is fixed.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem
from ._planned import THREE

CODE = "WM153"
SEVERITY = "error"
SCOPE = "plan"
GOOD = (THREE,)
STUCK = THREE.replace("<body name='mug' pos='.5 0 .25'><freejoint/>", "<body name='mug' pos='.5 0 .75'>")
BAD = (STUCK[: STUCK.index("<keyframe>")] + "</mujoco>",)
EVIDENCE = Measured("the mug hangs in the air", lambda s: height_after(s, 0.5), 0.3, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check scene objects, then assets; what a joint of the plan moves is left to the joint's rule."""
    assert view.plan is not None
    rows = [(o.name, o.dynamic and not o.fixed, o.visual_only) for o in view.plan.scene_objects]
    rows += [(n, a.is_dynamic and not a.fixed, None) for a in view.plan.assets for n in a.instances]
    jointed = {j.child for j in view.plan.topology.joints}
    driven = {b for i in view.plan.simulation_parameters.interventions if i.kind in ("mocap", "pose") for b in i.bodies}
    for name, moves, visual in rows:
        body = view.root_named(name)
        if body is None or visual or name in jointed | driven:
            continue
        free = bool(view.moving[body])
        if moves and not free:
            yield view.at("body", body, f"{name} should move, but its body has no joint", "add a free joint")
        elif free and not moves:
            yield view.at("body", body, f"{name} is fixed in the plan, but its body can move", "leave out its joint")
