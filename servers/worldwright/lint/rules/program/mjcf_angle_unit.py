"""An angle in MJCF is written in radians where the compiler reads degrees.

What it does: finds joint ranges and `euler` values that are well-known fractions of pi (1.57, 3.14, 0.785 …) in documents
whose compiler still reads degrees, the default.

Why is this bad: `range="-1.57 1.57"` is one and a half degrees: the joint looks locked. URDF and many examples use
radians, so such numbers are copied easily.

Use instead: `<compiler angle="radian"/>`, or degrees.
"""

import math
from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, model_of
from ...problem import Problem
from ...program_view import Program
from ._mjcf import walk

CODE = "WL143"
SEVERITY = "error"
SCOPE = "any"
DOOR = "<mujoco>{0}<worldbody><body><joint name='j' range='{1}'/><geom size='.1'/></body></worldbody></mujoco>"
GOOD = (
    Case(DOOR.format("", "-90 90"), path="a.xml"),
    Case(DOOR.format("<compiler angle='radian'/>", "-1.57 1.57"), path="a.xml"),
    Case(DOOR.format("", "0 1.57").replace("range", "type='slide' range"), path="a.xml"),
)
BAD = (
    Case(DOOR.format("", "-1.57 1.57"), path="a.xml"),
    Case("<mujoco><worldbody><body euler='0 0 3.14159'><geom size='.1'/></body></worldbody></mujoco>", path="a.xml"),
)
EVIDENCE = Measured("the door is locked", lambda s: math.degrees(float(model_of(s).jnt_range[0, 1])), 80.0, "degrees")
FRACTIONS = tuple(math.pi * f for f in (2, 1.5, 1, 0.75, 2 / 3, 0.5, 1 / 3, 0.25, 1 / 6))


def check(program: Program) -> Iterator[Problem]:
    """Check ranges of hinges and balls, and Euler angles."""
    fix = 'write degrees, or <compiler angle="radian"/>'
    for document in program.documents:
        tags = list(walk(document))
        if document.computed or any(t.name == "compiler" and "angle" in t.attributes for t, _ in tags):
            continue
        if any(t.name in ("include", "attach") for t, _ in tags) or (document.root and document.root.name != "mujoco"):
            continue
        for tag, _ in tags:
            linear = tag.attributes.get("type") in ("slide", "free") or tag.name != "joint"
            for name in ("euler", *(() if linear else ("range",))):
                words = tag.attributes.get(name, "").split()
                if words and any(_radian(word) for word in words):
                    message = (
                        f"{tag.name}/{name} `{tag.attributes[name]}` is in radians, but the compiler reads degrees"
                    )
                    yield Problem(message, fix, tag.line)


def _radian(word: str) -> bool:
    """Whether a number is a fraction of pi with at least two decimals, as somebody who meant radians writes it."""
    try:
        value = abs(float(word))
    except ValueError:
        return False
    decimals = len(word.partition(".")[2])
    return decimals >= 2 and any(abs(value - f) <= 0.5 * 10**-decimals + 1e-9 for f in FRACTIONS)
