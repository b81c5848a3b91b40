"""An MJCF element does not exist in the installed MuJoCo, or not at this place.

What it does: walks every MJCF document in the program's strings (or a bare model file) along the schema that the engine
itself prints.

Why is this bad: the model does not compile ("Schema violation: unrecognized element"). `composite`, the `flexvert`
equality and others are gone since 4.0.

Use instead: the nearest element, the place where it belongs, or what the changelog's migration says.
"""

from collections.abc import Iterator

from ....simulator import changelog, mjcf
from ...case import Case
from ...harm import Raises
from ...mjcf_text import Tag
from ...problem import Problem
from ...program_view import Program

CODE = "WL103"
ABOUT = "names"
LOOK_UP = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    'XML = "<mujoco><worldbody><frame><body><geom size=\\"1\\"/></body></frame></worldbody></mujoco>"\n',
    Case("<mujoco><default><default class='a'><geom rgba='1 0 0 1'/></default></default></mujoco>", path="a.xml"),
    "HTML = '<composite/>'\n",
)
BAD = (
    'import mujoco\nXML = """\n<mujoco>\n  <worldbody>\n    <composite type="grid"/>\n  </worldbody>\n</mujoco>"""\nmujoco.MjModel.from_xml_string(XML)\n',
    Case("<mujoco><equality><flexvert flex='cloth'/></equality></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><gem size='1'/></worldbody></mujoco>", path="a.xml"),
    Case("<mujoco><geom size='1'/></mujoco>", path="a.xml"),
)
EVIDENCE = Raises("Schema violation", good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check every element, outermost first; what stands inside an unknown one is not judged."""
    if not program.documents:
        return
    schema = mjcf.load()
    for document in program.documents:
        if document.root is None or document.root.name not in ("mujoco", "mujocoinclude"):
            continue
        included = document.root.name == "mujocoinclude"
        stack: list[tuple[Tag, mjcf.Element]] = [(document.root, schema.root)]
        while stack:
            tag, element = stack.pop()
            for child in tag.children:
                if child.name == "include":
                    continue
                inside = element.child(child.name)
                if inside is not None:
                    stack.append((child, inside))
                elif not (included and tag is document.root and child.name in schema.by_tag):
                    yield _unknown(schema, child, tag)


def _unknown(schema: mjcf.Schema, tag: Tag, parent: Tag) -> Problem:
    version = mjcf.symbols.load().version
    if tag.name in schema.by_tag:
        places = ", ".join(f"<{name}>" for name in schema.parents(tag.name)) or "another place"
        message = f"<{tag.name}> cannot stand inside <{parent.name}> in MuJoCo {version}"
        return Problem(message, f"it belongs inside {places}", tag.line)
    became = changelog.advice(tag.name)
    near = schema.nearest_element(tag.name)
    hints = ([became] if became else []) + (["nearest: " + ", ".join(f"<{n}>" for n in near)] if near else [])
    fix = "; ".join(hints) or f"look it up: worldwright retrieve search '{tag.name}'"
    return Problem(f"MuJoCo {version} has no MJCF element <{tag.name}>", fix, tag.line)
