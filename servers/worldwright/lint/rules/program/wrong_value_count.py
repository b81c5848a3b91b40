"""An MJCF attribute has too many or too few numbers, or something that is none.

What it does: counts the numbers of attributes with a fixed length (`pos` 3, `quat` 4, `rgba` 4, `range` 2, `fromto` 6 …)
and the sizes that a geom of its type needs.

Why is this bad: the model does not compile ("does not have enough data", "size 2 must be positive").

Use instead: as many numbers as the attribute takes.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Raises
from ...problem import Problem
from ...program_view import Program
from ._mjcf import walk

CODE = "WL107"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    Case(
        "<mujoco><worldbody><geom type='box' size='1 1 1' pos='0 0 1' friction='1'/></worldbody></mujoco>", path="a.xml"
    ),
    Case("<mujoco><worldbody><geom type='capsule' size='.1' fromto='0 0 0 0 0 1'/></worldbody></mujoco>", path="a.xml"),
    'XML = f\'<mujoco><worldbody><geom size="1" pos="{0}"/></worldbody></mujoco>\'\n',
)
BAD = (
    Case("<mujoco><worldbody><geom size='1' pos='0 0'/></worldbody></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><geom type='box' size='1 1'/></worldbody></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><geom size='1' rgba='1 0 0'/></worldbody></mujoco>", path="a.xml"),
    Case("<mujoco><option gravity='-9.81'/></mujoco>", path="a.xml"),
    Case("<mujoco><worldbody><geom size='1' pos='0 0 high'/></worldbody></mujoco>", path="a.xml"),
)
EVIDENCE = Raises()
COUNTS = {
    "pos": 3, "quat": 4, "euler": 3, "axisangle": 4, "xyaxes": 6, "zaxis": 3, "axis": 3, "rgba": 4, "fromto": 6,
    "gravity": 3, "wind": 3, "magnetic": 3, "diffuse": 3, "ambient": 3, "specular": 3,
}  # fmt: skip
SIZES = {"sphere": 1, "capsule": 2, "cylinder": 2, "box": 3, "ellipsoid": 3}
NOT_HERE = {("flag", "gravity"), ("material", "specular"), ("map", "zaxis"), ("default", "pos")}


def check(program: Program) -> Iterator[Problem]:
    """Check every attribute with a known length, outside text that is made at run time."""
    for document in program.documents:
        if document.computed:
            continue
        for tag, around in walk(document):
            for name, text in tag.attributes.items():
                count = COUNTS.get(name)
                if (
                    count is None
                    or (tag.name, name) in NOT_HERE
                    or (around and around[-1].name in ("plugin", "custom"))
                ):
                    continue
                words = text.split()
                if not all(_number(word) for word in words):
                    message = f"{tag.name}/{name} is `{text[:60]}`, which is not {count} numbers"
                    yield Problem(message, f"write {count} numbers", tag.line)
                elif len(words) != count:
                    message = f"{tag.name}/{name} has {len(words)} number{'s' * (len(words) != 1)}, it takes {count}"
                    yield Problem(message, f"write {count} numbers", tag.line)
            yield from _size(tag, any(a.name == "default" for a in around))


def _size(tag, in_default: bool) -> Iterator[Problem]:
    given, shape = tag.attributes.get("size"), tag.attributes.get("type")
    if tag.name != "geom" or in_default or given is None or shape not in SIZES or "mesh" in tag.attributes:
        return
    needed = 1 if "fromto" in tag.attributes else SIZES[shape]
    if len(given.split()) < needed and "class" not in tag.attributes:
        message = f"a {shape} takes {needed} sizes, `{given}` has {len(given.split())}"
        yield Problem(message, f"write {needed} half sizes", tag.line)


def _number(word: str) -> bool:
    try:
        float(word)
    except ValueError:
        return False
    return True
