"""A control is set beyond what its actuator takes.

What it does: compares literal values assigned to `data.ctrl[…]` with the `ctrlrange` of all actuators, when the whole
model stands in the program.

Why is this bad: the engine clamps it without a word: the motor gives less than what is written.

Use instead: a value within the range, or a wider range.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program
from ._written import writes

CODE = "WL155"
SEVERITY = "warning"
SCOPE = "any"
ARM = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body><joint name="j"/><geom size=".1"/>'
    '</body></worldbody><actuator><motor joint="j" ctrlrange="-1 1"/></actuator></mujoco>\')\n'
    "data = mujoco.MjData(model)\ndata.ctrl[0] = {0}\nmujoco.mj_step(model, data)\n"
)
GOOD = (ARM.format("1.0"), ARM.format("-0.5"))
BAD = (ARM.format("5.0"), ARM.format("-3"))


def _lost(source: str) -> float:
    """How much of the written control does not arrive as a torque, N m."""
    data = executed(source)["data"]
    return float(data.ctrl[0] - data.actuator_force[0])


EVIDENCE = Measured("4 of 5 N m never arrive", _lost, 1.0, "N m")


def check(program: Program) -> Iterator[Problem]:
    """Check numbers beyond every range."""
    if not program.whole_model or not any(True for _ in program.tags()):
        return
    ranges = []
    for document in program.documents:
        for section in document.root.children if document.root else ():
            for actuator in section.children if section.name == "actuator" else ():
                words = actuator.attributes.get("ctrlrange", "").split()
                if len(words) != 2 or actuator.attributes.get("ctrllimited") == "false":
                    return
                ranges.append((float(words[0]), float(words[1])))
    for write in writes(program):
        if write.field != "ctrl" or not isinstance(write.node, ast.Assign) or not ranges:
            continue
        value = program.value(write.node.value)
        if isinstance(value, int | float) and all(value < low or value > high for low, high in ranges):
            message = f"a control of {value:g} is clamped to {ranges[0][0]:g} … {ranges[0][1]:g}"
            yield at(write.node, message, "stay within ctrlrange, or widen it")
