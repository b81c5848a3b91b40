"""A copy is written to, and thrown away.

What it does: finds assignments into the result of `.copy()`, `np.array(…)`, `.tolist()`, or into a list-indexed selection,
of a field of the model or the data: `data.qpos.copy()[2] = 1`, `data.qpos[[0, 1]][0] = 1`.

Why is this bad: nothing happens. The simulation keeps the old value, and no error is raised.

Use instead: assign to the field itself: `data.qpos[2] = 1`.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL146"
SEVERITY = "error"
SCOPE = "any"
HEAD = (
    "import mujoco\nimport numpy as np\nmodel = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><freejoint/>"
    '<geom size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\n'
)
GOOD = (
    HEAD + "data.qpos[2] = 5\n",
    HEAD + "start = data.qpos.copy()\nstart[2] = 5\n",
    HEAD + "data.qpos[[0, 2]] = 5\n",
)
BAD = (
    HEAD + "data.qpos.copy()[2] = 5\n",
    HEAD + "np.array(data.qpos)[2] = 5\n",
    HEAD + "data.qpos[[0, 2]][1] = 5\n",
)
EVIDENCE = Measured("the position is not written", lambda s: float(executed(s)["data"].qpos[2]), 1.0, "m")
COPIES = frozenset({"copy", "tolist", "astype", "flatten"})


def check(program: Program) -> Iterator[Problem]:
    """Check targets of assignments."""
    for target, _, statement in program.stores():
        inner = target.value if isinstance(target, ast.Subscript) else None
        if inner is not None and _copies(program, inner):
            message = f"`{ast.unparse(target)}` writes to a copy that is thrown away"
            yield at(statement, message, "assign to the field itself")


def _copies(program: Program, node: ast.AST) -> bool:
    if isinstance(node, ast.Call):
        if isinstance(node.func, ast.Attribute) and node.func.attr in COPIES:
            return _field(program, node.func.value)
        return (
            program.dotted(node.func) in ("numpy.array", "numpy.copy")
            and bool(node.args)
            and _field(program, node.args[0])
        )
    if isinstance(node, ast.Subscript) and isinstance(node.slice, ast.List):
        return _field(program, node.value)
    return False


def _field(program: Program, node: ast.AST) -> bool:
    while isinstance(node, ast.Subscript):
        node = node.value
    return isinstance(node, ast.Attribute) and program.type_of(node.value) is not None
