"""A body's `inertial` silences the masses of its geoms.

What it does: finds MJCF bodies with an `<inertial>` and geoms that state a mass or a density of their own.

Why is this bad: with an `<inertial>`, the compiler takes mass and inertia from it alone (`inertiafromgeom="auto"`): the
numbers on the geoms do nothing.

Use instead: either the inertial or the geoms' masses; `<compiler inertiafromgeom="true"/>` prefers the geoms.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, model_of
from ...problem import Problem
from ...program_view import Program

CODE = "WL154"
SEVERITY = "warning"
SCOPE = "any"
BALL = "<mujoco>{0}<worldbody><body><freejoint/>{1}<geom size='.1' mass='2'/></body></worldbody></mujoco>"
INERTIAL = "<inertial pos='0 0 0' mass='.5' diaginertia='.01 .01 .01'/>"
GOOD = (
    Case(BALL.format("", ""), path="a.xml"),
    Case(BALL.format("<compiler inertiafromgeom='true'/>", INERTIAL), path="a.xml"),
    Case(BALL.format("", INERTIAL).replace(" mass='2'", ""), path="a.xml"),
)
BAD = (Case(BALL.format("", INERTIAL), path="a.xml"),)
EVIDENCE = Measured("the geom's 2 kg do not count", lambda s: float(model_of(s).body_mass[1]), 1.0, "kg")


def check(program: Program) -> Iterator[Problem]:
    """Check bodies with both; a mass of zero says the same as the inertial."""
    tags = list(program.tags())
    if any(t.name == "compiler" and t.attributes.get("inertiafromgeom") == "true" for t in tags):
        return
    for tag in tags:
        if tag.name != "body" or not any(c.name == "inertial" for c in tag.children):
            continue
        for child in tag.children:
            given = child.attributes.get("mass") or child.attributes.get("density")
            if child.name == "geom" and given and given.strip(" 0.") != "":
                message = f"the body's inertial overrides this geom's mass or density of {given}"
                yield Problem(message, "keep one of them", child.line)
