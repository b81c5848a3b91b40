"""A geom has both a mass and a density.

What it does: finds geoms with `mass` and `density` together, in MJCF and in `add_geom`.

Why is this bad: the density is ignored without a word. Whoever changes it later changes nothing.

Use instead: one of the two.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, model_of
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL153"
SEVERITY = "warning"
SCOPE = "any"
BALL = "<mujoco><worldbody><body><freejoint/><geom size='.1' {0}/></body></worldbody></mujoco>"
GOOD = (Case(BALL.format("density='700'"), path="a.xml"), Case(BALL.format("mass='2'"), path="a.xml"))
BAD = (
    Case(BALL.format("mass='2' density='700'"), path="a.xml"),
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(size=[1, 0, 0], mass=2, density=700)\n",
)


def _change_kg(source: str) -> float:
    """How much the mass changes when the density is halved, kg."""
    return abs(float(model_of(source).body_mass[1] - model_of(source.replace("700", "350")).body_mass[1]))


EVIDENCE = Measured("halving the density changes nothing", _change_kg, 0.5, "kg")


def check(program: Program) -> Iterator[Problem]:
    """Check elements, then calls."""
    message, fix = "the geom has a mass and a density: the density is ignored", "give one of the two"
    for tag in program.tags():
        if tag.name == "geom" and {"mass", "density"} <= set(tag.attributes):
            yield Problem(message, fix, tag.line)
    for call in program.method_calls("add_geom"):
        if {"mass", "density"} <= {k.arg for k in call.keywords}:
            yield at(call, message, fix)
