"""A control that is meant for the coming steps is written after them.

What it does: looks at functions that step the engine and are given what they write into `data.ctrl`: when the write comes
after the last step, it acts one call too late. A control that is reckoned from the state at the end of a loop is for the
next round, and left alone.

Why is this bad: every action acts in the next call; what the function returns is the answer to the action before.

Use instead: write `data.ctrl` first, then step.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program
from ._written import writes

CODE = "WL157"
SEVERITY = "warning"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body><joint name="j"/><geom size=".1"/>'
    '</body></worldbody><actuator><motor joint="j"/></actuator></mujoco>\')\ndata = mujoco.MjData(model)\n'
)
GOOD = (
    HEAD + "def step(action):\n    data.ctrl[:] = action\n    mujoco.mj_step(model, data)\nstep(1.0)\n",
    HEAD + "for _ in range(9):\n    mujoco.mj_step(model, data)\n    data.ctrl[0] = -data.qvel[0]\n",
    HEAD
    + "def run(action):\n    for _ in range(9):\n        mujoco.mj_step(model, data)\n        data.ctrl[0] = action\nrun(1.0)\n",
    HEAD
    + "def step(action):\n    mujoco.mj_step1(model, data)\n    data.ctrl[:] = action\n    mujoco.mj_step2(model, data)\nstep(1.0)\n",
)
BAD = (
    HEAD
    + "def step(action):\n    for _ in range(5):\n        mujoco.mj_step(model, data)\n    data.ctrl[:] = action\nstep(1.0)\n",
)
EVIDENCE = Measured("the first action moves nothing", lambda s: float(executed(s)["data"].qvel[0]), 0.05, "rad/s")
STEPS = ("mujoco.mj_step", "mujoco.mj_step1", "mujoco.mj_step2")


def check(program: Program) -> Iterator[Problem]:
    """Check writes of an argument, with every step of the function before them."""
    steps = [call for _, call in program.calls(*STEPS)]
    for function in program.nodes(ast.FunctionDef):
        given = {a.arg for a in (*function.args.args, *function.args.kwonlyargs)} - {"self", "model", "data", "m", "d"}
        mine = [s for s in steps if _within(s, function)]
        for write in writes(program):
            if (
                write.field != "ctrl"
                or not isinstance(write.node, ast.Assign)
                or not mine
                or not _within(write.node, function)
            ):
                continue
            names = {n.id for n in ast.walk(write.node.value) if isinstance(n, ast.Name)}
            after = all(s.lineno < write.node.lineno for s in mine)
            if names and names <= given and after and not _looped(function, write.node, mine):
                yield at(
                    write.node,
                    "this control is written after the last step: it acts one call too late",
                    "write it first",
                )


def _within(node: ast.AST, outer: ast.AST) -> bool:
    return outer.lineno <= node.lineno <= (outer.end_lineno or outer.lineno)  # type: ignore[attr-defined]


def _looped(function: ast.FunctionDef, node: ast.AST, steps: list[ast.Call]) -> bool:
    """Whether a loop of the function holds both the write and a step."""
    loops = [n for n in ast.walk(function) if isinstance(n, ast.For | ast.While) and _within(node, n)]
    return any(_within(step, loop) for loop in loops for step in steps)
