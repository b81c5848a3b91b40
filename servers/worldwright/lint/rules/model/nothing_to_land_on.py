"""A falling body has nothing below that could ever stop it.

What it does: finds free bodies under gravity that can touch other moving bodies, but no scenery, and that no equality,
tendon or mocap body holds. Where there is scenery and the masks pass it by, it speaks of the line that gives the masks.

Why is this bad: it falls out of the picture, and with it whatever it carries.

Use instead: a ground plane, or `gravity="0 0 0"` for a world in space.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem

CODE = "WM121"
SEVERITY = "warning"
SCOPE = "any"
TWO = (
    "<mujoco><worldbody>{0}<body name='a' pos='0 0 .5'><freejoint/><geom size='.1'/></body>"
    "<body name='b' pos='0 0 1'><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
)
GOOD = (
    TWO.format("<geom type='plane' size='5 5 .1'/>"),
    TWO.format("").replace("<world", "<option gravity='0 0 0'/><world", 1),
)
BAD = (
    TWO.format(""),
    TWO.format("<geom type='plane' size='5 5 .1' contype='2' conaffinity='2'/>"),
)
EVIDENCE = Measured("both are metres below after a second", height_after, 2.0, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check trees on a free joint that scenery, flexes and bonds leave alone."""
    if not view.gravity.any() or "gravity" in view.disabled or view.contacts_off or len(view.flex_dim):
        return
    scenery = ~view.moving[view.geom_bodyid]
    told: set[int] = set()
    held = len(view.eq_type) + len(view.tendon_stiffness) + int((view.body_mocapid >= 0).any())
    for joint, kind in enumerate(view.joint_kind):
        body = int(view.jnt_bodyid[joint])
        tree = view.body_treeid[view.geom_bodyid] == view.body_treeid[body]
        geoms = np.flatnonzero(tree)
        if kind != "free" or held or not len(geoms) or view.body_gravcomp[body]:
            continue
        met = [view.may_touch(int(g)) & ~tree for g in geoms]
        if any(m.any() for m in met) and not any((m & scenery).any() for m in met):
            message = f"{view.name('body', body)} falls for ever: no scenery can stop it"
            line = next(filter(None, (view.masks_line(int(g)) for g in geoms)), None)
            if line is None or not (scenery & view.collides).any():
                yield view.at("body", body, message, "add a ground plane, or switch gravity off")
            elif line not in told:
                told.add(line)
                yield Problem(message, "give it and the scenery masks with a common bit", line)
