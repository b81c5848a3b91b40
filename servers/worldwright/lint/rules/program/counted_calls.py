"""`control` counts how often it is called.

What it does: finds counters (`global` or `nonlocal` names, attributes, items) that `control` increments and compares.

Why is this bad: it is called once a step, so the count is a time in steps. At half the step everything the counter
triggers happens twice as early: the finer run, which must agree with the first, does not.

Use instead: `data.time`, or better the condition itself: a force, a distance, a contact.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL119"
SEVERITY = "error"
SCOPE = "contract"
HEAD = "from worldkit import program\nCOUNT = 0\nBOX = [0]\ndef build():\n    return None\n"
TAIL = "\nif __name__ == '__main__':\n    program.main(build, control, duration=3.0)\n"
GOOD = (
    HEAD + "def control(model, data):\n    if data.time > 1.0:\n        data.ctrl[0] = 1.0\n" + TAIL,
    HEAD
    + "def control(model, data):\n    total = 0\n    total += 1\n    if total > 3:\n        data.ctrl[0] = 1.0\n"
    + TAIL,
)
BAD = (
    HEAD
    + "def control(model, data):\n    global COUNT\n    COUNT += 1\n    if COUNT > 500:\n        data.ctrl[0] = 1.0\n"
    + TAIL,
    HEAD + "def control(model, data):\n    BOX[0] += 1\n    data.ctrl[0] = 1.0 if BOX[0] > 500 else 0.0\n" + TAIL,
)


def _shift_s(source: str) -> float:
    """How much earlier the motor starts at half the step, s."""
    import mujoco

    xml = (
        "<mujoco><option timestep='{0}'/><worldbody><body><joint name='j'/><geom size='.1'/></body></worldbody>"
        "<actuator><motor joint='j'/></actuator></mujoco>"
    )
    starts = []
    for step in (0.002, 0.001):
        space = executed(source)
        model = mujoco.MjModel.from_xml_string(xml.format(step))
        data = mujoco.MjData(model)
        while data.time < 3.0 and not data.ctrl[0]:
            space["control"](model, data)
            mujoco.mj_step(model, data)
        starts.append(data.time)
    return float(starts[0] - starts[1])


EVIDENCE = Measured("at half the step the motor starts half a second earlier", _shift_s, 0.3, "s")


def check(program: Program) -> Iterator[Problem]:
    """Check increments in functions that run every step, of what outlives the call, when it is compared somewhere there."""
    for node in program.nodes(ast.AugAssign):
        if not isinstance(node.op, ast.Add | ast.Sub) or not program.runs_every_step(node):
            continue
        if program.value(node.value) not in (1, -1) or not _outlives(program, node):
            continue
        counter = ast.unparse(node.target)
        function = next(f for f in program.scopes.chain(node) if f in program.running)
        assert function is not None
        for test in ast.walk(function):
            if isinstance(test, ast.Compare) and any(ast.unparse(e) == counter for e in [test.left, *test.comparators]):
                yield at(test, f"`{counter}` counts steps", "compare data.time, or the condition that is meant")
                break


def _outlives(program: Program, node: ast.AugAssign) -> bool:
    target = node.target
    if isinstance(target, ast.Name):
        return any((scope, target.id) in program.scopes.globals for scope in program.scopes.chain(node) if scope)
    owner: ast.AST = target
    while isinstance(owner, ast.Attribute | ast.Subscript):
        owner = owner.value
    return program.type_of(owner) is None and not (
        isinstance(owner, ast.Name) and program.scopes.scope_of(owner) in program.running
    )
