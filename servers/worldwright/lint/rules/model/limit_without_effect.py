"""A range is given that limits nothing.

What it does: finds joints, tendons and actuators with a range of their own that is switched off: `limited="false"`,
`ctrllimited="false"`, `forcelimited="false"`.

Why is this bad: the hinge swings through its stop, the motor gives any torque.

Use instead: leave `limited` at `auto`, or set it to true; remove the range where no limit is meant.
"""

from collections.abc import Iterator

from ...compiled.view import ModelView
from ...harm import Measured, after
from ...problem import Problem

CODE = "WM123"
SEVERITY = "error"
SCOPE = "any"
ARM = (
    "<mujoco><compiler {0}/><worldbody><body><joint name='hinge' axis='0 1 0' range='-20 20' {1}/>"
    "<geom type='capsule' size='.02' fromto='0 0 0 .3 0 0'/></body></worldbody></mujoco>"
)
GOOD = (ARM.format("", ""), ARM.format("autolimits='false'", "limited='true'"))
MOTOR = ARM.format("", "").replace("</worldbody>", "</worldbody><actuator><motor joint='hinge' {0}/></actuator>")
BAD = (ARM.format("", "limited='false'"), MOTOR.format("forcerange='-1 1' forcelimited='false'"))
EVIDENCE = Measured("the arm swings past 20 degrees", lambda s: float(after(s, 0.4)[1].qpos[0]), 0.5, "rad")
PLACES = (
    ("joint", "jnt_limited", "jnt_range", "range"),
    ("tendon", "tendon_limited", "tendon_range", "range"),
    ("actuator", "actuator_ctrllimited", "actuator_ctrlrange", "ctrlrange"),
    ("actuator", "actuator_forcelimited", "actuator_forcerange", "forcerange"),
)


def check(view: ModelView) -> Iterator[Problem]:
    """Check every range that is not zero, and not on."""
    for kind, limited, ranges, word in PLACES:
        switches, values = getattr(view, limited), getattr(view, ranges)
        if len(switches) != len(values):
            continue
        for index, (on, (low, high)) in enumerate(zip(switches, values, strict=True)):
            if not on and low < high:
                message = f"the {word} of {view.name(kind, index)} limits nothing: it is not switched on"
                yield view.at(kind, index, message, "set limited to true, or remove the range")
