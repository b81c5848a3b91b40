"""A free joint is given to a body that hangs on another.

What it does: finds free joints on bodies that are not children of the world, in MJCF and on `MjsBody` variables.

Why is this bad: the model does not compile: "free joint can only be used on top level". A body inside another moves with
it, and cannot be free of it.

Use instead: add the body to `worldbody`; tie it by an equality where it should stay with the other.
"""

import ast
from collections.abc import Iterator

from ...case import Case
from ...harm import Raises
from ...problem import Problem, at
from ...program_view import Program
from ._mjcf import walk

CODE = "WL116"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
HEAD = "import mujoco\nspec = mujoco.MjSpec()\na = spec.worldbody.add_body(name='a')\na.add_geom(size=[.1, 0, 0])\n"
GOOD = (
    HEAD + "a.add_freejoint()\n",
    Case(
        "<mujoco><worldbody><frame><body><freejoint/><geom size='1'/></body></frame></worldbody></mujoco>", path="a.xml"
    ),
)
BAD = (
    Case(
        "<mujoco><worldbody><body><geom size='1'/><body><freejoint/><geom size='1'/></body></body></worldbody></mujoco>",
        path="a.xml",
    ),
    HEAD + "b = a.add_body(name='b')\nb.add_geom(size=[.1, 0, 0])\nb.add_freejoint()\nmodel = spec.compile()\n",
)
EVIDENCE = Raises("top level|free joint")


def check(program: Program) -> Iterator[Problem]:
    """Check MJCF, then variables bound to `body.add_body()`."""
    message, fix = "a free joint on a body inside another body", "add the body to worldbody"
    for document in program.documents:
        for tag, around in walk(document):
            free = tag.name == "freejoint" or (tag.name == "joint" and tag.attributes.get("type") == "free")
            if free and sum(a.name == "body" for a in around) > 1 and "default" not in {a.name for a in around}:
                yield Problem(message, fix, tag.line)
    for call in program.method_calls("add_freejoint"):
        made = _adding_call(program, call.func.value)  # type: ignore[attr-defined]
        if made is not None and _adding_call(program, made.func.value) is not None:  # type: ignore[attr-defined]
            yield at(call, message, fix)


def _adding_call(program: Program, node: ast.AST) -> ast.Call | None:
    """The `add_body` call that a variable stands for."""
    bound = program.scopes.bound(node) if isinstance(node, ast.Name) else [node]
    made = bound[0] if len(bound) == 1 else None
    if isinstance(made, ast.Call) and isinstance(made.func, ast.Attribute) and made.func.attr == "add_body":
        return made
    return None
