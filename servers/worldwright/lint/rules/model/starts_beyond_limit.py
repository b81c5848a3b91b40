"""A joint starts outside its range.

What it does: compares the start position of every limited hinge and slide with its range.

Why is this bad: the limit throws the joint back with the first step: a kick nobody planned.

Use instead: a start inside the range; `ref` shifts what a position is counted from.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, fastest
from ...problem import Problem

CODE = "WM124"
SEVERITY = "error"
SCOPE = "any"
LID = (
    "<mujoco><option gravity='0 0 0'/><worldbody><body><joint name='hinge' range='{0}'/>"
    "<geom type='capsule' size='.02' fromto='0 0 0 .3 0 0'/></body></worldbody></mujoco>"
)
GOOD = (LID.format("-10 90"),)
BAD = (LID.format("30 90"),)
EVIDENCE = Measured("the limit throws the lid", fastest, 1.0, "rad/s")


def check(view: ModelView) -> Iterator[Problem]:
    """Check hinges and slides, with a hundredth of the range to spare."""
    for joint, kind in enumerate(view.joint_kind):
        if kind not in ("hinge", "slide") or not view.jnt_limited[joint]:
            continue
        low, high = (float(v) for v in view.jnt_range[joint])
        value = float(view.qpos[int(view.jnt_qposadr[joint])])
        spare = 0.01 * max(high - low, 1e-9)
        if value < low - spare or value > high + spare:
            unit = "rad" if kind == "hinge" else "m"
            message = f"{view.name('joint', joint)} starts at {value:.3g} {unit}, outside {low:.3g} to {high:.3g}"
            yield view.at("joint", joint, message, "start inside the range")
