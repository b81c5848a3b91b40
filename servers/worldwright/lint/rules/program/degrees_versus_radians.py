"""An angle is given in radians where the compiler reads degrees.

What it does: finds joint ranges, `euler`, `axisangle`, `springref`, `ref` and `fovy` made with `math.pi`, `np.radians`,
`deg2rad` and the like while the specification's compiler still has its default, degrees.

Why is this bad: a range of `(-pi/2, pi/2)` becomes 1.57 degrees: the joint looks locked. Nothing fails.

Use instead: degrees, or `spec.compiler.degree = False` for the whole model. Velocities and data at run time (`qpos`,
`qvel`) are always in radians.
"""

import ast
import math
from collections.abc import Iterator

from ...harm import Measured, model_of
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL141"
SEVERITY = "error"
SCOPE = "any"
HEAD = "import math\nimport mujoco\nimport numpy as np\nspec = mujoco.MjSpec()\nb = spec.worldbody.add_body()\n"
GOOD = (
    HEAD + "b.add_joint(range=(-90, 90))\n",
    HEAD + "spec.compiler.degree = False\nb.add_joint(range=(-math.pi / 2, math.pi / 2))\n",
    HEAD + "b.add_joint(range=np.rad2deg([-math.pi / 2, 1]))\n",
    HEAD + "b.add_joint(pos=(math.cos(math.pi / 3), 0, 0))\n",
    HEAD + "b.add_joint(type=mujoco.mjtJoint.mjJNT_SLIDE, range=(0, math.pi * 0.1))\n",
)
BAD = (
    HEAD + "b.add_joint(range=(-math.pi / 2, math.pi / 2))\n",
    HEAD + "b.add_geom(euler=(np.pi / 2, 0, 0))\n",
    HEAD + "LIMIT = np.deg2rad(45)\nj = b.add_joint()\nj.range = (-LIMIT, LIMIT)\n",
    HEAD + "c = b.add_camera(fovy=math.radians(45))\n",
)


def _range_deg(source: str) -> float:
    """The upper end of the joint's compiled range, degrees."""
    return math.degrees(float(model_of(source + "b.add_geom(size=[0.1, 0, 0])\n").jnt_range[0, 1]))


EVIDENCE = Measured("the joint is locked", _range_deg, 80.0, "degrees")
ANGLES = frozenset({"euler", "range", "springref", "ref", "fovy"})
OWNERS: frozenset[str | None] = frozenset(
    {"MjsBody", "MjsGeom", "MjsJoint", "MjsSite", "MjsCamera", "MjsFrame", "MjsLight"}
)
TO_RADIANS = frozenset({"radians", "deg2rad"})
TO_DEGREES = frozenset({"degrees", "rad2deg"})


def check(program: Program) -> Iterator[Problem]:
    """Check keywords of `add_*` calls on bodies, then assignments to the same fields."""
    if _radians(program):
        return
    fix = "give degrees (MjSpec's default), or set spec.compiler.degree = False"
    for call in program.method_calls("add_body", "add_geom", "add_joint", "add_site", "add_camera", "add_frame"):
        owner = program.type_of(call.func.value)  # type: ignore[attr-defined]
        if owner not in OWNERS or _slides(program, call):
            continue
        for keyword in call.keywords:
            if keyword.arg in ANGLES and _is_radian(program, keyword.value):
                yield at(keyword.value, f"`{keyword.arg}` is in radians, but the compiler reads degrees", fix)
    for target, value, statement in program.stores():
        if isinstance(target, ast.Attribute) and target.attr in ANGLES and program.type_of(target.value) in OWNERS:
            bound = program.scopes.bound(target.value) if isinstance(target.value, ast.Name) else []
            made = bound[0] if len(bound) == 1 else None
            if (
                value is not None
                and _is_radian(program, value)
                and not (isinstance(made, ast.Call) and _slides(program, made))
            ):
                yield at(statement, f"`{target.attr}` is in radians, but the compiler reads degrees", fix)


def _radians(program: Program) -> bool:
    """Whether the program chooses radians somewhere, or loads models whose compiler settings it does not see."""
    for target, value, _ in program.stores():
        if isinstance(target, ast.Attribute) and target.attr == "degree" and program.value(value) in (False, 0):
            return True
    return any(tag.name == "compiler" and tag.attributes.get("angle") == "radian" for tag in program.tags())


def _slides(program: Program, call: ast.Call) -> bool:
    return (program.dotted(program.argument(call, "type")) or "").endswith("mjJNT_SLIDE")


def _is_radian(program: Program, node: ast.expr, depth: int = 0) -> bool:
    """Whether pi or a conversion to radians is a factor of the value (not the argument of a sine)."""
    if depth > 12:
        return False
    if isinstance(node, ast.Call):
        name = (program.dotted(node.func) or "").rsplit(".", 1)[-1]
        if name in TO_RADIANS:
            return True
        wrappers = ("array", "asarray")
        return name in wrappers and any(_is_radian(program, a, depth + 1) for a in node.args)
    if isinstance(node, ast.Attribute):
        return program.dotted(node) in ("math.pi", "numpy.pi", "math.tau")
    if isinstance(node, ast.Name):
        if program.dotted(node) in ("math.pi", "numpy.pi", "math.tau"):
            return True
        bound = program.scopes.bound(node)
        return len(bound) == 1 and bound[0] is not None and _is_radian(program, bound[0], depth + 1)
    if isinstance(node, ast.BinOp):
        # x * 180 / pi turns radians into degrees: pi in a denominator is not an angle in radians.
        left = _is_radian(program, node.left, depth + 1)
        right = _is_radian(program, node.right, depth + 1) and not isinstance(node.op, ast.Div)
        return left or right
    if isinstance(node, ast.UnaryOp):
        return _is_radian(program, node.operand, depth + 1)
    if isinstance(node, ast.Tuple | ast.List):
        return any(_is_radian(program, item, depth + 1) for item in node.elts)
    return False
