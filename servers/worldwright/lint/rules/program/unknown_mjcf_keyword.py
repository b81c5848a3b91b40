"""An MJCF attribute has a value that is not one of its keywords.

What it does: where the manual lists the keywords of an attribute (`type="box"`, `integrator="implicitfast"`), compares
single-word values with the list.

Why is this bad: the model does not compile ("invalid keyword"). Keywords are case-sensitive, and some are gone.

Use instead: one of the listed keywords.
"""

import re
from collections.abc import Iterator
from difflib import get_close_matches

from ....simulator import changelog, mjcf
from ...bound_names import respelled
from ...case import Case
from ...harm import Raises
from ...problem import Problem
from ...program_view import Program

CODE = "WL105"
ABOUT = "names"
LOOK_UP = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    Case(
        "<mujoco><option integrator='RK4'/><worldbody><geom type='box' size='1 1 1'/></worldbody></mujoco>",
        path="a.xml",
    ),
    Case("<mujoco><visual><headlight active='1'/></visual></mujoco>", path="a.xml"),
)
BAD = (
    Case("<mujoco><option integrator='rk4'/></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><geom type='cube' size='1 1 1'/></worldbody></mujoco>", path="a.xml"),
    "import mujoco\nmujoco.MjModel.from_xml_string('<mujoco><option cone=\"eliptic\"/></mujoco>')\n",
)
FIXED = (Case("<mujoco><option integrator='RK4'/></mujoco>", path="a.xml"),)
EVIDENCE = Raises("invalid keyword", good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check every single-word value of an attribute with a list of keywords."""
    if not program.documents:
        return
    anchors, keywords = mjcf.anchors(), mjcf.keywords()
    for tag in program.tags():
        for name, value in tag.attributes.items():
            if not re.fullmatch(r"[A-Za-z]\w*", value):
                continue
            lists = [keywords[label] for label in anchors.get((tag.name, name), ()) if label in keywords]
            if not lists or len(lists) < len(anchors.get((tag.name, name), ())) // 2:
                continue
            known = sorted({word for words in lists for word in words})
            if value in known:
                continue
            became = changelog.advice(value)
            near = get_close_matches(value.lower(), known, n=1, cutoff=0.6) or [
                word for word in known if word.lower() == value.lower()
            ]
            hints = ([became] if became else []) + ([f"nearest: `{near[0]}`"] if near else [])
            hints.append("known: " + ", ".join(known))
            right = respelled(value, known)
            edit = program.word_edit(tag.line, value, right) if right else None
            message = f"`{value}` is no keyword of {tag.name}/{name}"
            yield Problem(message, "; ".join(hints), tag.line, edit=edit)
