"""A moving body can touch nothing.

What it does: finds bodies with a joint whose geoms all have `contype=0` and `conaffinity=0`.

Why is this bad: the body falls through the floor and through everything else; or a hand-written spring stands in for
the contact that was switched off.

Use instead: leave the masks at their default (1, 1) on at least one geom. What is only drawn belongs on a body of the
scenery and is declared `visual_only` in the plan.
"""

import ast
from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, height_after
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL135"
SEVERITY = "error"
SCOPE = "any"
HEAD = "import mujoco\nspec = mujoco.MjSpec()\nb = spec.worldbody.add_body(name='b')\n"
GOOD = (
    HEAD + "b.add_freejoint()\nb.add_geom(size=[1])\n",
    HEAD + "b.add_geom(size=[1], contype=0, conaffinity=0)\n",
    HEAD + "b.add_freejoint()\nb.add_geom(size=[1], contype=0, conaffinity=0)\nb.add_geom(size=[1])\n",
    HEAD + "b.add_joint()\nb.add_geom(size=[1], contype=0, conaffinity=0)\n",
)
BAD = (
    HEAD + "b.add_freejoint()\nb.add_geom(size=[1], contype=0, conaffinity=0)\n",
    HEAD + "OFF = 0\nb.add_freejoint(name='j')\nb.add_geom(size=[1], contype=OFF, conaffinity=OFF)\n"
    "b.add_geom(size=[2], contype=0, conaffinity=0)\n",
    Case(
        "<mujoco><worldbody><body><freejoint/><geom size='1' contype='0' conaffinity='0'/></body></worldbody></mujoco>",
        path="a.xml",
    ),
)
BALL = (
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 1])\n"
    "ball = spec.worldbody.add_body(pos=(0, 0, 0.5))\nball.add_freejoint()\nball.add_geom(size=[0.1, 0, 0]{0})\n"
)
EVIDENCE = Measured(
    "the ball falls through the floor",
    lambda s: height_after(s, 1.0),
    1.0,
    "m",
    bad=BALL.format(", contype=0, conaffinity=0"),
    good=BALL.format(""),
)


def check(program: Program) -> Iterator[Problem]:
    """Check free bodies held by one variable, then free bodies in MJCF.

    Only free bodies: a pendulum on a hinge may well be meant to touch nothing.
    """
    fix = "give one of its geoms contype=1 and conaffinity=1"
    geoms: dict[ast.AST, list[ast.Call]] = {}
    free: set[ast.AST] = set()
    for call in program.method_calls("add_geom", "add_freejoint"):
        variable = call.func.value  # type: ignore[attr-defined]
        bound = program.scopes.bound(variable) if isinstance(variable, ast.Name) else []
        if len(bound) != 1 or not isinstance(bound[0], ast.Call):
            continue
        if call.func.attr == "add_freejoint":  # type: ignore[attr-defined]
            free.add(bound[0])
        else:
            geoms.setdefault(bound[0], []).append(call)
    for body in free:
        if geoms.get(body) and all(_masked(program, call) for call in geoms[body]) and not _handed_on(program, body):
            yield at(geoms[body][0], "no geom of this free body can touch anything", fix)
    for tag in program.tags():
        shapes = [child for child in tag.children if child.name == "geom"]
        loose = any(c.name == "freejoint" or c.attributes.get("type") == "free" for c in tag.children)
        off = all(s.attributes.get("contype") == "0" and s.attributes.get("conaffinity") == "0" for s in shapes)
        if tag.name == "body" and shapes and loose and off and not any(c.name == "body" for c in tag.children):
            yield Problem("no geom of this free body can touch anything", fix, tag.line)


def _masked(program: Program, call: ast.Call) -> bool:
    return all(
        program.argument(call, name) is not None and program.value(program.argument(call, name)) == 0
        for name in ("contype", "conaffinity")
    )


def _handed_on(program: Program, body: ast.AST) -> bool:
    """Whether the body is an argument of another call, which may add geoms to it."""
    assigned = program.parent(body)
    names = {t.id for t in getattr(assigned, "targets", []) if isinstance(t, ast.Name)}
    return any(
        isinstance(argument, ast.Name) and argument.id in names
        for call in program.nodes(ast.Call)
        for argument in [*call.args, *(k.value for k in call.keywords)]
    ) or any(
        isinstance(call.func.value, ast.Name) and call.func.value.id in names  # type: ignore[attr-defined]
        for call in program.method_calls("add_body", "attach_frame", "add_frame", "make_flex")
    )
