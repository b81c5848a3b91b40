"""Derived quantities are read before the engine has computed them.

What it does: follows `MjData` variables through a block: after `MjData(model)` or a write to `qpos`, reading `xpos`,
`geom_xpos`, `site_xpos`, `sensordata`, `ncon`-dependent fields and the like, before anything is called with the data.

A view that is only kept for later (`place = data.xpos[1]`) is no reading.

Why is this bad: a fresh `MjData` holds zeros, and after a write to `qpos` the old poses: no error, wrong numbers.

Use instead: `mujoco.mj_forward(model, data)` (or `mj_kinematics` for poses alone) in between.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program
from ._written import DERIVED

CODE = "WL144"
SEVERITY = "error"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body name="b" pos="0 0 3"><freejoint/>'
    '<geom size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\n'
)
GOOD = (
    HEAD + "mujoco.mj_forward(model, data)\nheight = data.xpos[1, 2]\n",
    HEAD + "for _ in range(3):\n    mujoco.mj_step(model, data)\nheight = data.xpos[1, 2]\n",
    HEAD + "height = data.qpos[2]\n",
    HEAD + "def height():\n    return data.xpos[1, 2]\n",
    HEAD + "place = data.xpos[1]\nmujoco.mj_step(model, data)\nheight = place[2]\n",
)
BAD = (
    HEAD + "height = data.xpos[1, 2]\n",
    HEAD + "height = data.body('b').xpos[2]\n",
    HEAD + "mujoco.mj_forward(model, data)\ndata.qpos[2] = 9\nheight = data.xpos[1, 2]\n",
)
EVIDENCE = Measured("the height is zero", lambda s: float(executed(s)["height"]), 1.0, "m")
WRITES = frozenset({"qpos", "mocap_pos", "mocap_quat"})
NOT_POSES = frozenset({"qacc", "energy"})
"""Programs read these before and after a step for reasons of their own."""


def check(program: Program) -> Iterator[Problem]:
    """Check every block of statements, one after the other; what a branch or a loop did is taken for an update."""
    if not DERIVED & {n.attr for n in program.nodes(ast.Attribute)}:
        return
    for holder in [program.tree, *program.nodes(ast.FunctionDef)]:
        yield from _block(program, holder.body)


def _block(program: Program, statements: list[ast.stmt]) -> Iterator[Problem]:
    stale: dict[str, str] = {}
    for statement in statements:
        nodes = [] if isinstance(statement, ast.FunctionDef | ast.ClassDef | ast.Import) else list(ast.walk(statement))
        used = {name for node in nodes if isinstance(node, ast.Call) for name in _passed_names(node)}
        for name in used & set(stale):
            del stale[name]
        simple = isinstance(statement, ast.Assign | ast.AugAssign | ast.AnnAssign | ast.Expr | ast.Return)
        for node in nodes:
            found = _read(program, node)
            if found and simple and found[0] in stale:
                message = f"data.{found[1]} is read {stale[found[0]]}, before the engine has computed it"
                yield at(node, message, "call mujoco.mj_forward(model, data) first")
                del stale[found[0]]
        if not simple:
            stale.clear()
            continue
        if isinstance(statement, ast.Assign) and isinstance(statement.targets[0], ast.Name):
            made = statement.value
            if isinstance(made, ast.Call) and program.dotted(made.func) == "mujoco.MjData":
                stale[statement.targets[0].id] = "right after MjData(model)"
        if isinstance(statement, ast.Assign | ast.AugAssign):
            target = statement.targets[0] if isinstance(statement, ast.Assign) else statement.target
            written = _field(program, target)
            if written and written[1] in WRITES:
                stale[written[0]] = f"right after a write to {written[1]}"


def _passed_names(call: ast.Call) -> Iterator[str]:
    """Names that are handed to a call, also inside other arguments."""
    for argument in [*call.args, *(k.value for k in call.keywords)]:
        if isinstance(argument, ast.Name):
            yield argument.id


def _field(program: Program, node: ast.AST) -> tuple[str, str] | None:
    """(variable, field) of `data.field[…]` or `data.body('x').field[…]`."""
    while isinstance(node, ast.Subscript):
        node = node.value
    if not isinstance(node, ast.Attribute):
        return None
    owner = node.value
    if isinstance(owner, ast.Call) and isinstance(owner.func, ast.Attribute):
        owner = owner.func.value
    if isinstance(owner, ast.Name) and program.type_of(owner) == "MjData":
        return owner.id, node.attr
    return None


def _read(program: Program, node: ast.AST) -> tuple[str, str] | None:
    """(variable, field) where a derived value is really read, as a number, operand or argument, not kept as a view."""
    if not (isinstance(node, ast.Attribute) and isinstance(node.ctx, ast.Load) and node.attr in DERIVED - NOT_POSES):
        return None
    named = isinstance(node.value, ast.Call)  # data.body('b').xpos is one row already
    member = program.symbols.member("MjData", node.attr) or {}
    left = 1 if named or " x " not in str(member.get("doc")) else 2
    inner: ast.AST = node
    around = program.parent(node)
    while isinstance(around, ast.Subscript) and around.value is inner:
        if not isinstance(around.ctx, ast.Load):  # it is written to, which is another rule's business
            return None
        parts = around.slice.elts if isinstance(around.slice, ast.Tuple) else [around.slice]
        left -= sum(not isinstance(part, ast.Slice | ast.List) for part in parts)
        inner, around = around, program.parent(around)
    used = isinstance(around, ast.BinOp | ast.Compare | ast.UnaryOp | ast.FormattedValue | ast.Attribute)
    used = used or (isinstance(around, ast.Call) and inner in around.args)
    return _field(program, node) if left <= 0 or used else None
