"""Gravity points upwards.

What it does: finds gravity vectors with a positive z component, in Python and MJCF.

Why is this bad: everything falls to the sky. The sign is easily lost where gravity is written as the number 9.81.

Use instead: `(0, 0, -9.81)`; in a world turned on purpose, an ignore that says so.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, height_after
from ...problem import Problem, at
from ...program_view import Program
from ...stated import gravities

CODE = "WL152"
SEVERITY = "warning"
SCOPE = "any"
BALL = "<mujoco><option gravity='0 0 {0}'/><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
GOOD = (Case(BALL.format("-9.81"), path="a.xml"), Case(BALL.format("0"), path="a.xml"))
BAD = (
    Case(BALL.format("9.81"), path="a.xml"),
    "import mujoco\nG = 9.81\nspec = mujoco.MjSpec()\nspec.option.gravity = (0, 0, G)\n",
)
EVIDENCE = Measured("the ball rises", lambda s: height_after(s, 0.5), 1.0, "m")


def check(program: Program) -> Iterator[Problem]:
    """Check every gravity the program states; a plan that says so is believed."""
    planned = program.plan.simulation_parameters.gravity_vector[2] if program.plan else 0.0
    for value, line, node in gravities(program):
        if (
            isinstance(value, tuple)
            and len(value) == 3
            and isinstance(value[2], int | float)
            and value[2] > 0 >= planned
        ):
            message, fix = f"gravity points up: {value[2]:g} m/s^2 along +z", f"write {-value[2]:g}"
            yield at(node, message, fix) if node is not None else Problem(message, fix, line)
