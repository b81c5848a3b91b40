"""A free body can meet nothing in its world.

What it does: compares the contact masks (`contype`, `conaffinity`), pairs and exclusions of every free body with those of
everything else; also contacts that are switched off for the whole world. A body that is alone in its world is left alone.

Why is this bad: it falls through the floor and through all others. Masks that are set but never match look right and do
nothing.

Use instead: masks with a common bit (`contype` of one & `conaffinity` of the other); 1 and 1 are the default.
"""

from collections.abc import Iterator

import numpy as np

from ...compiled.view import ModelView
from ...harm import Measured, height_after
from ...problem import Problem

CODE = "WM120"
SEVERITY = "error"
SCOPE = "any"
BALL = (
    "<mujoco><worldbody><geom name='floor' type='plane' size='5 5 .1' {0}/><body name='ball' pos='0 0 .3'><freejoint/>"
    "<geom size='.1' {1}/></body></worldbody></mujoco>"
)
GOOD = (
    BALL.format("", ""),
    BALL.format("contype='2' conaffinity='2'", "contype='3' conaffinity='0'"),
    "<mujoco><option gravity='0 0 0'/><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>",
)
BAD = (
    BALL.format("contype='2' conaffinity='4'", "contype='1' conaffinity='8'"),
    BALL.format("", "contype='0' conaffinity='0'"),
    (
        "<mujoco><option><flag contact='disable'/></option><worldbody><geom type='plane' size='1 1 1'/>"
        "<body pos='0 0 1'><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
    ),
)
EVIDENCE = Measured("the ball falls through the floor", height_after, 1.0, "m")


def check(view: ModelView) -> Iterator[Problem]:
    """Check every tree that hangs on a free joint."""
    flexes = bool(((view.flex_contype != 0) | (view.flex_conaffinity != 0)).any())
    visual = {o.name for o in view.plan.scene_objects if o.visual_only} if view.plan else set()
    for joint, kind in enumerate(view.joint_kind):
        body = int(view.jnt_bodyid[joint])
        tree = view.body_treeid[view.geom_bodyid] == view.body_treeid[body]
        geoms = np.flatnonzero(tree)
        if kind != "free" or not len(geoms) or tree.all() or view.name("body", body) in visual:
            continue
        if view.contacts_off:
            yield view.at("body", body, f"{view.name('body', body)} meets nothing: contacts are off", "switch them on")
        elif not any(view.may_touch(int(g))[~tree].any() for g in geoms):
            if flexes and view.collides[geoms].any():
                continue
            reason = "its masks match no other's" if view.collides[geoms].any() else "contype and conaffinity are 0"
            message = f"{view.name('body', body)} can touch nothing: {reason}"
            yield view.at("body", body, message, "give it and what it should meet masks with a common bit")
