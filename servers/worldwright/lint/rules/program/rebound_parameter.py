"""A function works on a new array and forgets the one it was given.

What it does: finds a parameter that is bound anew to arithmetic on itself (`q = q + noise`) and never read again, in a
program that uses the engine.

Why is this bad: the name now stands for another array. What the caller passed, often `data.qpos`, stays as it was.

Use instead: `q += noise` or `q[:] = q + noise`, which write into the array, or return the new one.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, answer
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL170"
SEVERITY = "warning"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body><joint/><geom size=".1"/></body>'
    "</worldbody></mujoco>')\ndata = mujoco.MjData(model)\n"
)
GOOD = (
    HEAD + "def push(q):\n    q += 1\npush(data.qpos)\nanswer = data.qpos[0]\n",
    HEAD + "def moved(q):\n    q = q + 1\n    return q\nanswer = moved(data.qpos)[0]\n",
)
BAD = (HEAD + "def push(q):\n    q = q + 1\npush(data.qpos)\nanswer = data.qpos[0]\n",)
EVIDENCE = Measured("nothing moves", answer, 0.5, "rad")


def check(program: Program) -> Iterator[Problem]:
    """Check assignments of a function's parameters to arithmetic on themselves, which are the last word on them."""
    if not any(full.split(".")[0] == "mujoco" for table in program.scopes.imports.values() for full in table.values()):
        return
    for function in program.nodes(ast.FunctionDef):
        names = {a.arg for a in [*function.args.posonlyargs, *function.args.args, *function.args.kwonlyargs]}
        loads = [n for n in ast.walk(function) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Load)]
        looped = [n for n in ast.walk(function) if isinstance(n, ast.For | ast.While)]
        for statement in ast.walk(function):
            if not isinstance(statement, ast.Assign) or len(statement.targets) != 1:
                continue
            target, value = statement.targets[0], statement.value
            if not (isinstance(target, ast.Name) and target.id in names and isinstance(value, ast.BinOp)):
                continue
            own = {n for n in ast.walk(value) if isinstance(n, ast.Name)}
            if target.id not in {n.id for n in own}:
                continue
            last = statement.end_lineno or statement.lineno
            around = [w for w in looped if w.lineno <= statement.lineno <= (w.end_lineno or w.lineno)]
            read = any(
                n.id == target.id and n not in own and (n.lineno > last or any(_in(n, w) for w in around))
                for n in loads
            )
            if not read:
                message = f"`{target.id}` is bound to a new array and never read: the caller's array does not change"
                yield at(statement, message, f"write into it: {target.id}[:] = …")


def _in(node: ast.Name, loop: ast.For | ast.While) -> bool:
    return loop.lineno <= node.lineno <= (loop.end_lineno or loop.lineno)
