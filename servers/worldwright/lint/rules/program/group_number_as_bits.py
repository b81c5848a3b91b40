"""A group's number is written into a field of bits.

What it does: finds writes to `opt.disableactuator` whose value is a plain number, a name or a look-up, and not a shift.

Why is this bad: each bit stands for a group. The number 2 is the bit of group 1, so the wrong actuators are switched off.

Use instead: `model.opt.disableactuator |= 1 << group`.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, answer
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL171"
SEVERITY = "warning"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body><joint name="j"/><geom size=".1"/>'
    '</body></worldbody><actuator><motor joint="j" group="2"/></actuator></mujoco>\')\ndata = mujoco.MjData(model)\n'
    "group = 2\n"
)
TAIL = "data.ctrl[0] = 1\nmujoco.mj_step(model, data)\nanswer = data.qvel[0]\n"
GOOD = (
    HEAD + "model.opt.disableactuator |= 1 << group\n" + TAIL,
    HEAD + "bits = 1 << group\nmodel.opt.disableactuator = bits\n" + TAIL,
    HEAD + "model.opt.disableactuator = 0\n" + TAIL,
)
BAD = (
    HEAD + "model.opt.disableactuator |= group\n" + TAIL,
    HEAD
    + "GROUPS = {'arm': 2}\ndef without(name):\n    model.opt.disableactuator |= GROUPS[name]\nwithout('arm')\n"
    + TAIL,
)
EVIDENCE = Measured("the motor still turns", answer, 0.01, "rad/s")


def check(program: Program) -> Iterator[Problem]:
    """Check assignments, plain and augmented."""
    for node in (*program.nodes(ast.Assign), *program.nodes(ast.AugAssign)):
        targets = node.targets if isinstance(node, ast.Assign) else [node.target]
        if not any(isinstance(t, ast.Attribute) and t.attr == "disableactuator" for t in targets):
            continue
        value = node.value
        if isinstance(value, ast.Name):
            bound = program.scopes.bound(value)
            value = bound[0] if len(bound) == 1 and bound[0] is not None else value
            if isinstance(value, ast.Attribute):  # an earlier value is put back
                continue
        number = value.value if isinstance(value, ast.Constant) else None
        plain = isinstance(value, ast.Name | ast.Subscript) or (isinstance(number, int) and number > 1)
        written = program.lines[value.lineno - 1][value.col_offset : value.end_col_offset] if plain else ""
        if plain and not written.startswith(("0x", "0b")):
            yield at(node, "disableactuator is a field of bits, here given a number as it is", "write 1 << group")
