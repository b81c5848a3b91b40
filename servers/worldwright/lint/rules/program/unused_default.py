"""A default class is declared, and nothing uses it.

What it does: finds `<default class="x">` that no `class` or `childclass` of the document names, nor a class inside it.

Why is this bad: its settings look as if they applied (`contype`, `friction`, `density` …), and apply to nothing.

Use instead: `class="x"` on the elements, or `childclass="x"` on a body around them; settings for everything belong
directly into the outermost `<default>`.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, model_of
from ...mjcf_text import Tag
from ...problem import Problem
from ...program_view import Program
from ._mjcf import closed, walk

CODE = "WL156"
SEVERITY = "warning"
SCOPE = "any"
BALL = (
    "<mujoco><default><default class='wood'><geom density='700'/></default></default><worldbody><body><freejoint/>"
    "<geom size='.1' {0}/></body></worldbody></mujoco>"
)
GOOD = (
    Case(BALL.format("class='wood'"), path="a.xml"),
    Case(BALL.format("").replace("<body>", "<body childclass='wood'>"), path="a.xml"),
)
BAD = (Case(BALL.format(""), path="a.xml"),)
EVIDENCE = Measured("the ball is not of wood", lambda s: float(model_of(s).body_mass[1]), 0.5, "kg")


def check(program: Program) -> Iterator[Problem]:
    """Check classes of documents that are whole."""
    for document in program.documents:
        if not closed(document):
            continue
        tags = list(walk(document))
        used = {
            t.attributes[k]
            for t, _ in tags
            if t.name != "default"
            for k in ("class", "childclass")
            if k in t.attributes
        }
        used |= program.strings if not program.source.is_mjcf else set()
        bodies = any(t.name == "worldbody" for t, _ in tags)
        for tag, around in tags:
            name = tag.attributes.get("class")
            inner = tag.name == "default" and any(a.name == "default" for a in around)
            if inner and bodies and name and not (_classes(tag) & used):
                yield Problem(
                    f"nothing uses the default class `{name}`", f'write class="{name}" where it is meant', tag.line
                )


def _classes(tag: Tag) -> set[str]:
    """The class and those inside it."""
    found = {tag.attributes["class"]} if "class" in tag.attributes else set()
    for child in tag.children:
        if child.name == "default":
            found |= _classes(child)
    return found
