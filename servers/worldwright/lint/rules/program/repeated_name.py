"""Two objects of one kind have the same name in MJCF.

What it does: looks for names that are given twice among bodies, geoms, joints, actuators and so on of one document.

Why is this bad: the model does not compile ("repeated name").

Use instead: a name for each; `<replicate>` numbers its copies by itself.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Raises
from ...problem import Problem
from ...program_view import Program
from ._mjcf import kind, walk

CODE = "WL109"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
TWO = "<mujoco><worldbody><geom name='{0}' size='1'/><{2} name='{1}' size='1'/></worldbody></mujoco>"
GOOD = (Case(TWO.format("a", "b", "geom"), path="a.xml"), Case(TWO.format("a", "a", "site"), path="a.xml"))
BAD = (Case(TWO.format("a", "a", "geom"), path="a.xml"),)
EVIDENCE = Raises("repeated name")


def check(program: Program) -> Iterator[Problem]:
    """Check names of one kind, in the order of the text."""
    for document in program.documents:
        first: dict[tuple[str, str], int] = {}
        if document.computed:
            continue
        for tag, around in walk(document):
            made = kind(tag, around)
            if made is None or not tag.attributes["name"]:
                continue
            key = (made, tag.attributes["name"])
            if key in first:
                yield Problem(
                    f"there is already a {made} `{key[1]}` (line {first[key]})", "give it another name", tag.line
                )
            first.setdefault(key, tag.line)
