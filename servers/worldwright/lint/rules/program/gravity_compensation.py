"""A body is relieved of its weight.

What it does: finds `gravcomp` set to anything but zero, on a body in Python or in MJCF.

Why is this bad: the body floats, or a boom holds itself up, by an invisible force that no contact and no actuator
supplies.

Use instead: support it by something. A balloon's buoyancy is a force to be declared as an intervention with its law, or
the fluid model (`option density`, geom `fluidshape`).
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, height_after
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL134"
SEVERITY = "error"
SCOPE = "contract"
HEAD = "from worldkit import scene\nspec = scene.new('a', time_step=0.001)\n"
GOOD = (HEAD + "b = spec.worldbody.add_body(name='b', gravcomp=0)\n", HEAD + "weight = spec.worldbody.gravcomp\n")
BAD = (
    HEAD + "b = spec.worldbody.add_body(name='b', gravcomp=1)\n",
    HEAD + "b = spec.worldbody.add_body(name='b')\nb.gravcomp = 0.5\n",
    HEAD + "XML = '<mujoco><worldbody><body gravcomp=\"1\"/></worldbody></mujoco>'\n",
)
BALL = (
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=[5, 5, 1])\n"
    "ball = spec.worldbody.add_body(pos=(0, 0, 0.5), {0})\nball.add_freejoint()\nball.add_geom(size=[0.1, 0, 0])\n"
)
EVIDENCE = Measured(
    "the ball hangs in the air",
    lambda s: height_after(s, 1.0),
    0.2,
    "m",
    bad=BALL.format("gravcomp=1"),
    good=BALL.format(""),
)


def check(program: Program) -> Iterator[Problem]:
    """Check keywords, assignments and attributes."""
    fix = "let a support, an actuator or a declared force carry it"
    for call in program.nodes(ast.Call):
        for keyword in call.keywords:
            if keyword.arg == "gravcomp" and program.value(keyword.value) != 0:
                yield at(keyword.value, "gravcomp takes the weight off a body", fix)
    for target, value, statement in program.stores():
        if isinstance(target, ast.Subscript):
            target = target.value
        if (
            isinstance(target, ast.Attribute)
            and target.attr in ("gravcomp", "body_gravcomp")
            and program.value(value) != 0
        ):
            yield at(statement, "gravcomp takes the weight off a body", fix)
    for tag in program.tags():
        if tag.attributes.get("gravcomp", "0").strip() not in ("0", "0.0"):
            yield Problem("gravcomp takes the weight off a body", fix, tag.line)
