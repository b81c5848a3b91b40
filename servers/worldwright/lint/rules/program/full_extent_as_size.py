"""The `size` of a box is a number that the same program halves to place it.

What it does: looks at boxes whose `size` is made of plain names, in `add_geom` and in computed MJCF, when the program
halves one of these names elsewhere: then it is a full extent.

Why is this bad: the size of a box is half of it: the box is twice as large in every direction, and stands in the floor.

Use instead: `size=[width / 2, depth / 2, height / 2]`.
"""

import ast
import re
from collections.abc import Iterator

from ...harm import Measured, model_of
from ...problem import Problem
from ...program_view import Program

CODE = "WL158"
SEVERITY = "warning"
SCOPE = "any"
HEAD = "import mujoco\nspec = mujoco.MjSpec()\nheight = 0.7\nbox = mujoco.mjtGeom.mjGEOM_BOX\n"
TEXT = "import mujoco\nh = 0.4\nspec = mujoco.MjSpec.from_string(f'<mujoco><worldbody><geom type=\"box\" {0}/></worldbody></mujoco>')\n"
GOOD = (
    HEAD + "spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, height / 2], pos=[0, 0, height / 2])\n",
    HEAD + "spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, height], pos=[0, 0, height])\n",
    TEXT.format('size="1 1 {h / 2}" pos="0 0 {h / 2}"'),
)
BAD = (
    HEAD + "spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, height], pos=[0, 0, height / 2])\n",
    TEXT.format('size="1 1 {h}" pos="0 0 {h / 2}"'),
)
EVIDENCE = Measured("the box is twice as high", lambda s: float(model_of(s).geom_size[0, 2]), 0.2, "m")


def check(program: Program) -> Iterator[Problem]:
    """Check boxes in calls, then boxes in computed text."""
    halved = {name for node in program.nodes(ast.BinOp) if (name := _halved(node))}
    message = "`{0}` is the size of a box here, and is halved elsewhere: sizes of boxes are half extents"
    for call in program.method_calls("add_geom"):
        if not (program.dotted(program.argument(call, "type")) or "").endswith("mjGEOM_BOX"):
            continue
        size = program.argument(call, "size")
        for part in size.elts if isinstance(size, ast.List | ast.Tuple) else ():
            if isinstance(part, ast.Name | ast.Attribute) and ast.unparse(part) in halved:
                yield Problem(message.format(ast.unparse(part)), f"{ast.unparse(part)} / 2", size.lineno)  # type: ignore[union-attr]
                break
    for number, line in enumerate(program.lines, 1):
        text = re.search(r'size=\\?["\'](.*?)["\']', line)
        if "<geom" not in line or not re.search(r'type=\\?["\']box', line) or text is None:
            continue
        names = [n for n in re.findall(r"\{([\w.]+)(?::[^}]*)?\}", text[1]) if n in halved]
        if names:
            yield Problem(message.format(names[0]), f"{{{names[0]} / 2}}", number)


def _halved(node: ast.BinOp) -> str:
    """The name that is halved, or nothing."""
    by = {ast.Div: 2, ast.Mult: 0.5}.get(type(node.op))
    for one, other in ((node.left, node.right), (node.right, node.left)):
        if (
            isinstance(other, ast.Constant)
            and by is not None
            and other.value == by
            and isinstance(one, ast.Name | ast.Attribute)
        ):
            return ast.unparse(one) if other is node.right or by == 0.5 else ""
    return ""
