"""An MJCF attribute does not exist on its element.

What it does: compares every attribute in the program's MJCF with the schema that the engine itself prints.

Why is this bad: the model does not compile ("Schema violation: unrecognized attribute"). Attributes were renamed
(a camera's `orthographic` became `projection`) and removed (`collision`, `apirate`).

Use instead: the nearest attribute, or what the changelog's migration says.
"""

from collections.abc import Iterator
from difflib import get_close_matches

from ....simulator import changelog, mjcf
from ...bound_names import respelled
from ...case import Case
from ...harm import Raises
from ...mjcf_text import Tag
from ...problem import Problem
from ...program_view import Program

CODE = "WL104"
ABOUT = "names"
LOOK_UP = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    Case(
        "<mujoco><option timestep='0.001'/><worldbody><geom size='1' surfacevel='1 0 0'/></worldbody></mujoco>".replace(
            "<mujoco>", "<mujoco model='m'>"
        ),
        path="a.xml",
    ),
    Case(
        "<mujoco><worldbody><replicate count='3' offset='1 0 0'><geom size='1'/></replicate></worldbody></mujoco>",
        path="a.xml",
    ),
)
BAD = (
    Case("<mujoco><option time_step='0.001'/></mujoco>", path="a.xml"),
    Case("<mujoco><option collision='all'/></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><camera orthographic='true'/></worldbody></mujoco>", path="a.xml"),
    "import mujoco\nmujoco.MjModel.from_xml_string('<mujoco><worldbody><geom siz=\"1\"/></worldbody></mujoco>')\n",
)
FIXED = (Case("<mujoco><option timestep='0.001'/></mujoco>", path="a.xml"),)
EVIDENCE = Raises("Schema violation", good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check every attribute of every element whose place in the schema is known."""
    if not program.documents:
        return
    schema = mjcf.load()
    for document in program.documents:
        if document.root is None or document.root.name not in ("mujoco", "mujocoinclude"):
            continue
        stack: list[tuple[Tag, mjcf.Element]] = [(document.root, schema.root)]
        while stack:
            tag, element = stack.pop()
            if tag.name != "mujocoinclude":
                yield from _attributes(program, tag, element)
            for child in tag.children:
                inside = element.child(child.name)
                if inside is not None:
                    stack.append((child, inside))


def _attributes(program: Program, tag: Tag, element: mjcf.Element) -> Iterator[Problem]:
    for name in tag.attributes:
        if name in element.attributes or ":" in name or name.startswith("xmlns"):
            continue
        became = changelog.advice(name)
        near = get_close_matches(name, sorted(element.attributes), n=3, cutoff=0.55)
        hints = ([became] if became else []) + (["nearest: " + ", ".join(f"`{n}`" for n in near)] if near else [])
        fix = "; ".join(hints) or "it takes: " + ", ".join(sorted(element.attributes)[:40])
        version = mjcf.symbols.load().version
        right = respelled(name, element.attributes)
        edit = program.word_edit(tag.line, name, right) if right and right not in tag.attributes else None
        message = f"<{tag.name}> has no attribute `{name}` in MuJoCo {version}"
        yield Problem(message, fix, tag.line, edit=edit)
