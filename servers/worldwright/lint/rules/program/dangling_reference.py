"""An MJCF attribute names an object that the model does not have.

What it does: resolves `joint`, `site`, `body1`, `geom1`, `material`, `mesh`, `texture`, `class`, `target` and the like
against the names of the document; documents with includes or generated names, and texts that the program makes
other texts of, are left alone.

Why is this bad: the model does not compile ("unknown transmission target", "material not found").

Use instead: the name as it is declared; names are case-sensitive.
"""

from collections.abc import Iterator
from difflib import get_close_matches
from pathlib import PurePosixPath

from ...case import Case
from ...harm import Raises
from ...mjcf_text import Document
from ...problem import Problem
from ...program_view import Program
from ._mjcf import closed, kind, walk

CODE = "WL108"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
ARM = "<mujoco><worldbody><body name='arm'><joint name='elbow'/><geom size='.1'/></body></worldbody>{0}</mujoco>"
GOOD = (
    Case(ARM.format("<actuator><motor joint='elbow'/></actuator>"), path="a.xml"),
    Case(ARM.format("<contact><exclude body1='arm' body2='world'/></contact>"), path="a.xml"),
    Case(
        'import mujoco\nTEXT = "' + ARM.format("<actuator><motor joint='wrist'/></actuator>") + '"\n'
        "model = mujoco.MjModel.from_xml_string(TEXT.replace('elbow', 'wrist'))\n"
    ),
)
BAD = (
    Case(ARM.format("<actuator><motor joint='elbo'/></actuator>"), path="a.xml"),
    Case(ARM.format("<equality><weld body1='hand'/></equality>"), path="a.xml"),
    Case("<mujoco><worldbody><geom size='1' material='wood'/></worldbody></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><geom size='1' class='visual'/></worldbody></mujoco>", path="a.xml"),
)
EVIDENCE = Raises()
REFERENCES = {
    "joint": "joint", "joint1": "joint", "joint2": "joint", "jointinparent": "joint", "site": "site", "site1": "site",
    "site2": "site", "refsite": "site", "cranksite": "site", "slidersite": "site", "sidesite": "site", "body": "body",
    "body1": "body", "body2": "body", "geom": "geom", "geom1": "geom", "geom2": "geom", "tendon": "tendon",
    "tendon1": "tendon", "tendon2": "tendon", "actuator": "actuator", "material": "material", "mesh": "mesh",
    "hfield": "hfield", "texture": "texture", "target": "body", "class": "default", "childclass": "default",
}  # fmt: skip
NAMED_BY_FILE = ("mesh", "texture", "hfield", "skin")
PLACES = {"equality": ("joint1", "joint2", "body1", "body2", "site1", "site2", "tendon1", "tendon2", "geom1", "geom2")}


def check(program: Program) -> Iterator[Problem]:
    """Check documents whose names all stand in the text."""
    for document in program.documents:
        if closed(document):
            yield from _document(document)


def _document(document: Document) -> Iterator[Problem]:
    known: dict[str, set[str]] = {"body": {"world"}, "default": {"main"}}
    for tag, around in walk(document):
        made = kind(tag, around)
        if made:
            known.setdefault(made, set()).add(tag.attributes["name"])
        elif tag.name in NAMED_BY_FILE and "file" in tag.attributes:
            known.setdefault(tag.name, set()).add(PurePosixPath(tag.attributes["file"]).stem)
        if tag.name == "default" and "class" in tag.attributes:
            known["default"].add(tag.attributes["class"])
    for tag, around in walk(document):
        sections = [a.name for a in around]
        if tag.name == "default" or {"custom", "extension", "skin", "deformable"} & set(sections):
            continue
        for attribute, name in tag.attributes.items():
            wanted = REFERENCES.get(attribute)
            if wanted is None or not name or tag.name in ("plugin", "instance", "config", "tuple", "element"):
                continue
            if name not in known.get(wanted, ()):
                near = get_close_matches(name, sorted(known.get(wanted, ())), n=3, cutoff=0.5)
                what = "default class" if wanted == "default" else wanted
                message = f"{tag.name}/{attribute} names the {what} `{name}`, which the model does not have"
                fix = (
                    "nearest: " + ", ".join(f"`{n}`" for n in near)
                    if near
                    else f"declare it, or name a {what} that is there"
                )
                yield Problem(message, fix, tag.line)
