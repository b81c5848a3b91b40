"""`control` reads constraint forces that are not there yet.

What it does: finds `efc_force`, `cfrc_ext`, `cfrc_int` or `mj_contactForce` in functions that run every step, without an
`mj_forward(model, data)` before.

Why is this bad: control is called between the two halves of a step. The constraint forces of this state are computed in
the second half: until then the memory holds leftovers of another layout, which differ from run to run.

Use instead: a touch or force sensor, whose reading is of the step before and well defined; or `mujoco.mj_forward(model,
data)` first.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL127"
SEVERITY = "error"
SCOPE = "contract"
HEAD = "import mujoco\nfrom worldkit import program\ndef build():\n    return None\n"
TAIL = "\nif __name__ == '__main__':\n    program.main(build, control, duration=3.0)\n"
GOOD = (
    HEAD + "def control(model, data):\n    mujoco.mj_forward(model, data)\n    return data.efc_force.sum()\n" + TAIL,
    HEAD + "def control(model, data):\n    return data.sensordata[0]\n" + TAIL,
)
BAD = (
    HEAD + "def control(model, data):\n    return data.efc_force.sum()\n" + TAIL,
    HEAD
    + "import numpy as np\ndef control(model, data):\n    f = np.zeros(6)\n    mujoco.mj_contactForce(model, data, 0, f)\n"
    + TAIL,
)


def _error_n(source: str) -> float:
    """The largest error of the force that control sees while a box tumbles onto the floor, N."""
    import mujoco

    space = executed(source)
    model = mujoco.MjModel.from_xml_string(
        "<mujoco><worldbody><geom type='plane' size='5 5 .1'/><body pos='0 0 .4' euler='20 30 0'><freejoint/>"
        "<geom type='box' size='.1 .1 .1'/></body></worldbody></mujoco>"
    )
    data, truth, worst = mujoco.MjData(model), mujoco.MjData(model), 0.0
    for _ in range(400):
        mujoco.mj_step1(model, data)
        mujoco.mj_copyData(truth, model, data)
        mujoco.mj_forward(model, truth)
        worst = max(worst, abs(float(space["control"](model, data)) - float(truth.efc_force.sum())))
        mujoco.mj_step2(model, data)
    return worst


EVIDENCE = Measured("the force that control sees is wrong by many newtons", _error_n, 10.0, "N")
STALE = frozenset({"efc_force", "cfrc_ext", "cfrc_int"})


def check(program: Program) -> Iterator[Problem]:
    """Check reads before the first `mj_forward` of the function."""
    fix = "read a sensor, or call mujoco.mj_forward(model, data) first"
    for function in program.running:
        fresh = min(
            (call.lineno for _, call in program.calls("mujoco.mj_forward") if function in program.scopes.chain(call)),
            default=10**9,
        )
        for node in ast.walk(function):
            line = getattr(node, "lineno", 0)
            if line >= fresh:
                continue
            if (
                isinstance(node, ast.Attribute)
                and node.attr in STALE
                and (program.type_of(node.value) or "").endswith("MjData")
            ):
                yield at(node, f"data.{node.attr} is not computed yet when control is called", fix)
            elif isinstance(node, ast.Call) and program.dotted(node.func) == "mujoco.mj_contactForce":
                yield at(node, "contact forces are not computed yet when control is called", fix)
