"""An array is indexed with the id of something else.

What it does: follows `model.body("x").id`, `mj_name2id(model, mjOBJ_…, "x")` into subscripts, and compares the kind with
what the array is ordered by: `qpos` and `qvel` by joint addresses, `geom_xpos` by geoms, `mocap_pos` by mocap ids.

Why is this bad: the number is valid, so another object's value is read or written. With one free body, body id 1 is the
second component of its position.

Use instead: `data.joint("x").qpos`, `data.body("x").xpos`, or `model.jnt_qposadr[joint]`, `model.body_mocapid[body]`.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL150"
SEVERITY = "error"
SCOPE = "any"
HEAD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body name="b" pos="0 0 3">'
    '<freejoint name="j"/><geom name="g" size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\n'
    "mujoco.mj_forward(model, data)\n"
)
GOOD = (
    HEAD + "height = data.qpos[model.jnt_qposadr[model.joint('j').id] + 2]\n",
    HEAD + "height = data.xpos[model.body('b').id][2]\n",
    HEAD + "body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, 'b')\nheight = data.xpos[body, 2]\n",
)
BAD = (
    HEAD + "height = data.qpos[model.body('b').id]\n",
    HEAD
    + "height = data.geom_xpos[model.body('b').id - 0][2] if False else data.geom_xpos[model.body('b').id - 1][2]\n"
    "height = data.xpos[model.geom('g').id][2]\n",
    HEAD + "body = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, 'b')\nheight = data.qvel[body]\n",
)
EVIDENCE = Measured("another number than the height is read", lambda s: float(executed(s)["height"]), 1.0, "m")
ORDER = {
    "xpos": "body", "xquat": "body", "xmat": "body", "xipos": "body", "ximat": "body", "xfrc_applied": "body",
    "cvel": "body", "cacc": "body", "cfrc_ext": "body", "cfrc_int": "body", "subtree_com": "body",
    "geom_xpos": "geom", "geom_xmat": "geom", "site_xpos": "site", "site_xmat": "site", "cam_xpos": "camera",
    "cam_xmat": "camera", "light_xpos": "light", "ten_length": "tendon", "ten_velocity": "tendon",
    "mocap_pos": "mocap body", "mocap_quat": "mocap body", "qpos": "joint address", "qvel": "dof address",
    "qacc": "dof address", "qfrc_applied": "dof address", "eq_active": "equality",
}  # fmt: skip
PREFIXES = {"body_": "body", "geom_": "geom", "site_": "site", "cam_": "camera", "jnt_": "joint", "light_": "light"}
KINDS = {
    "body": "body", "geom": "geom", "site": "site", "cam": "camera", "camera": "camera", "joint": "joint", "jnt": "joint",
    "light": "light", "tendon": "tendon", "actuator": "actuator", "sensor": "sensor", "equality": "equality", "eq": "equality",
}  # fmt: skip
SCALAR = {"joint address", "dof address"}
"""A joint's id is its address if every joint before it has one coordinate, which is common and not judged."""


def check(program: Program) -> Iterator[Problem]:
    """Check subscripts of known arrays with ids of known kinds."""
    for node in program.nodes(ast.Subscript):
        field = node.value
        if not isinstance(field, ast.Attribute) or program.type_of(field.value) not in ("MjData", "MjModel"):
            continue
        order = ORDER.get(field.attr) or next((k for p, k in PREFIXES.items() if field.attr.startswith(p)), None)
        index = node.slice.elts[0] if isinstance(node.slice, ast.Tuple) and node.slice.elts else node.slice
        kind = _kind(program, index)
        if order is None or kind is None or kind == order or (order in SCALAR and kind == "joint"):
            continue
        yield at(node, f"`{field.attr}` is ordered by {order}, and indexed with the id of a {kind}", _fix(order))


def _fix(order: str) -> str:
    if order in SCALAR:
        return 'read data.joint("…"), or index with model.jnt_qposadr or jnt_dofadr of the joint'
    if order == "mocap body":
        return "index with model.body_mocapid[body]"
    return f"use the id of the {order}"


def _kind(program: Program, node: ast.AST | None) -> str | None:
    """The kind of object whose id an expression is."""
    if isinstance(node, ast.Name):
        bound = program.scopes.bound(node)
        return _kind(program, bound[0]) if len(bound) == 1 and not isinstance(bound[0], ast.Name) else None
    if isinstance(node, ast.Attribute) and node.attr == "id" and isinstance(node.value, ast.Call):
        function = node.value.func
        if isinstance(function, ast.Attribute) and program.type_of(function.value) in ("MjModel", "MjData"):
            return KINDS.get(function.attr)
    if isinstance(node, ast.Call) and program.dotted(node.func) == "mujoco.mj_name2id" and len(node.args) > 1:
        name = (program.dotted(node.args[1]) or "").rsplit("mjOBJ_", 1)
        return KINDS.get(name[-1].lower().removeprefix("x")) if len(name) == 2 else None
    return None
