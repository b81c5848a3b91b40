"""A part of the physics is switched off.

What it does: finds disable flags for contact, gravity, constraints, limits, friction loss, equality or actuation, set
in Python (`mjDSBL_CONTACT` …) or in MJCF (`<flag contact="disable"/>`).

Why is this bad: bodies pass through each other, hang in the air or ignore their joints, and the picture does not say
so.

Use instead: leave the physics on. Bodies that must not meet are told apart by `contype`/`conaffinity` or `<exclude>`,
with a reason; weightlessness is the plan's gravity.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, height_after
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL133"
SEVERITY = "error"
SCOPE = "contract"
HEAD = "import mujoco\nfrom worldkit import scene\nspec = scene.new('a', time_step=0.001)\n"
GOOD = (
    HEAD + "spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_WARMSTART\n",
    HEAD + "if spec.option.disableflags & mujoco.mjtDisableBit.mjDSBL_CONTACT:\n    raise ValueError\n",
    HEAD + "XML = '<mujoco><option><flag energy=\"enable\"/></option></mujoco>'\n",
)
BAD = (
    HEAD + "spec.option.disableflags |= mujoco.mjtDisableBit.mjDSBL_CONTACT\n",
    HEAD + "D = mujoco.mjtDisableBit\nspec.option.disableflags = D.mjDSBL_GRAVITY | D.mjDSBL_WARMSTART\n",
    HEAD + "XML = '<mujoco><option><flag contact=\"disable\"/></option></mujoco>'\n",
    HEAD + "XML = '<mujoco><option><flag gravity=\"disable\"/></option></mujoco>'\n",
)
WORLD = (
    "<mujoco><option><flag contact='{0}'/></option><worldbody><geom type='plane' size='5 5 .1'/><body pos='0 0 .5'>"
    "<freejoint/><geom size='.1'/></body></worldbody></mujoco>"
)
OFF, ON = WORLD.format("disable"), WORLD.format("enable")
EVIDENCE = Measured("the ball falls through the floor", lambda s: height_after(s, 1.0), 1.0, "m", bad=OFF, good=ON)
_PARTS_WORDS = """
    contact gravity constraint limit frictionloss equality actuation spring damper
"""
PARTS = frozenset(_PARTS_WORDS.split())


def check(program: Program) -> Iterator[Problem]:
    """Check stores to `disableflags` that mention a bit of real physics; flags in MJCF."""
    for target, _, statement in program.stores():
        if not (isinstance(target, ast.Attribute) and target.attr == "disableflags"):
            continue
        if isinstance(statement, ast.AugAssign) and isinstance(statement.op, ast.BitAnd):
            continue
        for node in ast.walk(statement):
            bit = node.attr if isinstance(node, ast.Attribute) else ""
            part = bit.removeprefix("mjDSBL_").lower()
            if bit.startswith("mjDSBL_") and part in PARTS:
                yield at(node, f"{part} is switched off ({bit})", "leave the physics on")
    for tag in program.tags():
        for part in PARTS if tag.name == "flag" else ():
            if tag.attributes.get(part) == "disable":
                yield Problem(f'{part} is switched off (<flag {part}="disable"/>)', "leave the physics on", tag.line)
