"""A live array of the simulation is stored instead of its values.

What it does: finds `….append(data.qpos)` and the like: whole arrays, slices or rows of `MjData` put into a list without a
copy.

Why is this bad: the bindings return views of the engine's memory. Every entry of the list is the same array, and at the
end all show the last state: a trajectory that stands still.

Use instead: `.append(data.qpos.copy())`.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL145"
SEVERITY = "error"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body><freejoint/><geom size=".1"/></body>'
    "</worldbody></mujoco>')\ndata = mujoco.MjData(model)\nlog = []\nfor _ in range(100):\n    mujoco.mj_step(model, data)\n"
)
CLASS = (
    "import mujoco\nclass Env:\n    def __init__(self, path):\n        self.model = mujoco.MjModel.from_xml_path(path)\n"
    "        self.data = mujoco.MjData(self.model)\n        self.log = []\n    def step(self):\n"
)
GOOD = (
    HEAD + "    log.append(data.qpos.copy())\n",
    HEAD + "    log.append(data.qpos[2])\n",
    HEAD + "    log.append(data.xpos[1, 2])\n",
    HEAD + "    log.append(float(data.time))\n",
    CLASS + "        self.log.append(self.data.time)\n",
)
BAD = (
    HEAD + "    log.append(data.qpos)\n",
    HEAD + "    log.append((data.time, data.qpos[:3]))\n",
    HEAD + "    log.append(data.xpos[1])\n",
    CLASS + "        self.log.append(self.data.qpos)\n",
)
FIXED = (
    HEAD + "    log.append(data.qpos.copy())\n",
    HEAD + "    log.append((data.time, data.qpos[:3].copy()))\n",
    HEAD + "    log.append(data.xpos[1].copy())\n",
    CLASS + "        self.log.append(self.data.qpos.copy())\n",
)
EVIDENCE = Measured("first and last entry are the same", lambda s: float(abs(_ends(s)).max()), 0.1, "m")


def _ends(source: str):
    """How far the last entry differs from the first."""
    log = executed(source)["log"]
    return log[-1] - log[0]


def check(program: Program) -> Iterator[Problem]:
    """Check arguments of `append`, also inside tuples, lists and dicts."""
    for call in program.method_calls("append", "appendleft"):
        if program.type_of(call.func.value) is not None:  # type: ignore[attr-defined]
            continue
        waiting = list(call.args)
        while waiting:
            item = waiting.pop()
            if isinstance(item, ast.Tuple | ast.List):
                waiting += item.elts
            elif isinstance(item, ast.Dict):
                waiting += item.values
            elif _is_view(program, item):
                shown = ast.unparse(item)
                edit = program.insertion_after(item, ".copy()")
                yield at(
                    item,
                    f"`{shown}` is a view: every entry will show the last state",
                    f"append {shown}.copy()",
                    edit=edit,
                )


def _is_view(program: Program, node: ast.expr) -> bool:
    """Whether an expression is an array of MjData that lives on, not a number or a copy."""
    index: ast.AST | None = None
    if isinstance(node, ast.Subscript):
        index, node = node.slice, node.value
    if not isinstance(node, ast.Attribute) or program.type_of(node.value) != "MjData":
        return False
    member = program.symbols.member("MjData", node.attr)
    if member is None or "[]" not in str(member.get("returns")):
        return False
    if index is None or isinstance(index, ast.Slice):
        return True
    if isinstance(index, ast.Tuple):
        return any(isinstance(part, ast.Slice) for part in index.elts) and not any(
            isinstance(p, ast.List) for p in index.elts
        )
    rows = " x " in str(member.get("doc"))
    return rows and not isinstance(index, ast.List | ast.Compare | ast.Call | ast.Name | ast.Attribute)
