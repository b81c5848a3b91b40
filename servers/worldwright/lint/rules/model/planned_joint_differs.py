"""A joint of the plan is missing, or of another kind, range or stiffness.

What it does: looks for every joint of `topology.joints` in the compiled world, and compares its type, its range (degrees
or metres), its stiffness and damping.

Why is this bad: the mechanism is another one. A range in radians that the compiler reads as degrees locks the hinge.

Use instead: the plan's joint, under its name.
"""

from collections.abc import Iterator

import numpy as np

from ....model.plan.committed import Joint
from ...compiled.view import ModelView
from ...harm import Measured, model_of
from ...problem import Problem
from ._planned import THREE

CODE = "WM157"
SEVERITY = "error"
SCOPE = "plan"
ROWS = [{"name": "swing", "type": "hinge", "parent": "world", "child": "crate", "axis": [0, 1, 0], "range": [-45, 45]}]
PLAN = {"topology": {"joints": ROWS}, "simulation_parameters": {"initial_motion": None}}
SWING = THREE[: THREE.index("<keyframe>")] + "</mujoco>"
SWING = SWING.replace(
    "<freejoint/><geom type='box'", "<joint name='swing' axis='0 1 0' range='-45 45' pos='.3 0 1'/><geom type='box'"
)
FOUR = (
    THREE[: THREE.index("<body name='mug'")] + "<body name='mug' pos='.5 0 .25'><joint name='turn' axis='0 1 0'/>"
    "<geom type='cylinder' size='.04 .05' mass='.35'/></body></worldbody>{}</mujoco>"
)
LOOP = [
    {"name": "turn", "type": "hinge", "child": "mug", "axis": [0, 1, 0]},
    {"name": "pin", "type": "ball", "parent": "crate", "child": "mug"},
]
LOOPED = {"topology": {"joints": LOOP}, "simulation_parameters": {"initial_motion": None}}
TIE = "<equality><connect name='pin' body1='mug' body2='crate' anchor='0 0 0'/></equality>"
GOOD = ((SWING, PLAN), (FOUR.format(TIE), LOOPED))
BAD = (
    (FOUR.format(""), LOOPED),
    (SWING.replace("-45 45", "-0.785 0.785"), PLAN),
    (SWING.replace("'swing'", "'pivot'"), PLAN),
    (SWING.replace("axis='0 1 0' range='-45 45'", "type='slide' axis='0 1 0'"), PLAN),
)
EVIDENCE = Measured("the hinge is locked", lambda s: float(np.degrees(model_of(s).jnt_range[0, 1])), 40.0, "degrees")
KINDS = {"hinge": "hinge", "slide": "slide", "ball": "ball"}


def check(view: ModelView) -> Iterator[Problem]:
    """Check every joint of the plan but welds, which are no joints to the engine."""
    assert view.plan is not None
    names = view.texts["names"]["joint"]
    loops = view.plan.topology.loops()
    for row in view.plan.topology.joints:
        if row in loops:
            if row.name not in view.texts["names"]["equality"]:
                message = f"joint `{row.name}` of the plan closes a loop, and no constraint of that name does"
                yield view.of_world(message, f"add it by `worldkit.loops.{row.type}`", row.name, row.child)
            continue
        if row.type == "weld":
            continue
        if row.name not in names:
            message = f"joint `{row.name}` of the plan is not in the compiled world"
            yield view.of_world(message, f"add it to {row.child} under that name", row.name, row.child)
            continue
        index = names.index(row.name)
        if view.joint_kind[index] != KINDS[row.type]:
            message = f"joint {row.name} is a {view.joint_kind[index]}, the plan says {row.type}"
            yield view.at("joint", index, message, f"make it a {row.type}")
            continue
        yield from _compared(view, index, row)


def _compared(view: ModelView, index: int, row: Joint) -> Iterator[Problem]:
    scale = 180 / np.pi if row.type == "hinge" else 1.0
    if row.range is not None:
        built = view.jnt_range[index] * scale
        if not view.jnt_limited[index] or not np.allclose(built, row.range, rtol=1e-3, atol=1e-3):
            words = f"{built[0]:.3g} to {built[1]:.3g}" if view.jnt_limited[index] else "unlimited"
            message = f"the range of {row.name} is {words}, the plan says {row.range[0]:g} to {row.range[1]:g}"
            yield view.at("joint", index, message, "give the plan's range, in the compiler's angle unit")
    first = int(view.jnt_dofadr[index])
    for word, value, planned in (
        ("stiffness", view.jnt_stiffness[index], row.stiffness),
        ("damping", view.dof_damping[first], row.damping),
        ("frictionloss", view.dof_frictionloss[first], row.frictionloss),
    ):
        if not np.isclose(float(value), planned, rtol=1e-3, atol=1e-9):
            message = f"the {word} of {row.name} is {float(value):.4g}, the plan says {planned:g}"
            yield view.at("joint", index, message, f"set it to {planned:g}")
