"""A quaternion looks as if its scalar came last.

What it does: looks at literal quaternions for bodies, geoms, sites, cameras and mocap bodies. `(0, 0, 0, 1)` is the
identity where the scalar comes last (ROS, scipy, glTF); in MuJoCo, where it comes first, it is half a turn about z.
All zeros is no rotation at all.

Why is this bad: the object stands the wrong way round or upside down, and nothing fails: MuJoCo normalises what it
gets.

Use instead: `(w, x, y, z)`; the identity is `(1, 0, 0, 0)`. Or `yaw_deg`, `euler`, `axisangle`, which say what is
meant.
"""

import ast
from collections.abc import Iterator
from math import isclose
from typing import Any

from ...case import Case
from ...harm import Measured, after
from ...problem import Problem
from ...program_view import Program

CODE = "WL140"
SEVERITY = "warning"
SCOPE = "any"
HEAD = "import mujoco\nspec = mujoco.MjSpec()\n"
GOOD = (
    HEAD + "spec.worldbody.add_body(name='b', quat=(1, 0, 0, 0))\n",
    HEAD + "spec.worldbody.add_body(name='b', quat=(0.7071, 0, 0, 0.7071))\n",
)
BAD = (
    HEAD + "spec.worldbody.add_body(name='b', quat=(0, 0, 0, 1))\n",
    HEAD + "b = spec.worldbody.add_body(name='b')\nb.quat = [0, 0, 0, 0]\n",
    Case("<mujoco><worldbody><body quat='0 0 0 1'/></worldbody></mujoco>", path="a.xml"),
)


def _forward(source: str) -> float:
    """Where the tip of the body points along x, m."""
    return float(after(source + "spec.bodies[1].add_geom(size=[0.1, 0, 0], pos=(1, 0, 0))\n", 0.0)[1].geom_xpos[0, 0])


EVIDENCE = Measured("the body is turned by half a turn", _forward, 0.5, "m", good=0)


def check(program: Program) -> Iterator[Problem]:
    """Check keywords, assignments and attributes named `quat`."""
    for call in program.nodes(ast.Call):
        for keyword in call.keywords:
            if keyword.arg == "quat":
                yield from _judge(program, program.value(keyword.value), keyword.value.lineno)
    for target, value, statement in program.stores():
        if isinstance(target, ast.Attribute) and target.attr == "quat":
            yield from _judge(program, program.value(value), statement.lineno)
    for tag in program.tags():
        if "quat" in tag.attributes:
            try:
                yield from _judge(program, tuple(float(v) for v in tag.attributes["quat"].split()), tag.line)
            except ValueError:
                continue


def _judge(program: Program, value: Any, line: int) -> Iterator[Problem]:
    if not isinstance(value, tuple) or len(value) != 4 or not all(isinstance(v, int | float) for v in value):
        return
    if not any(value):
        yield Problem("a quaternion of zeros is no rotation", "the identity is (1, 0, 0, 0)", line, severity="error")
    elif isclose(abs(value[3]), 1.0) and not any(value[:3]):
        message = "(0, 0, 0, 1) is half a turn about z: MuJoCo's quaternions are (w, x, y, z)"
        fix = "the identity is (1, 0, 0, 0); for half a turn write euler or axisangle"
        # Elsewhere it may well be meant: it is worth a warning only in programs drafted from yaw angles.
        yield Problem(message, fix, line, severity="warning" if program.contract else "info")
