"""The file cannot be read as a program.

What it does: reports an empty, binary, non-UTF-8, oversized, syntactically broken or absurdly nested file, and MJCF
that is not well-formed XML.

Why is this bad: nothing else can be said about such a file, and it would fail, or hang, in the first pass.

Use instead: a UTF-8 Python file that parses. The line and column are where the parser stopped.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Raises
from ...problem import Problem
from ...program_view import Program

CODE = "WL100"
ABOUT = "names"
SEVERITY = "error"
SCOPE = "file"
GOOD = ("x = 1\n", Case("<mujoco/>", path="model.xml"), 'XML = "<mujoco><worldbody/></mujoco>"\n')
BAD = (
    "",
    "def build(:\n    pass\n",
    "(" * 5000 + ")" * 5000,
    "x = 1" + " + 1" * 20000,
    Case("<mujoco><worldbody></mujoco>", path="model.xml"),
    'XML = """\n<mujoco>\n  <worldbody>\n</mujoco>\n"""\n',
)
EVIDENCE = Raises(without=(0, 5), good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check the reader's own complaint, then every MJCF document that does not parse."""
    if program.source.problem is not None:
        yield program.source.problem
        return
    for document in program.documents:
        if document.root is None and not document.computed:  # a computed part may be a whole attribute or element
            what = document.error or "it has no element"
            yield Problem(f"the MJCF is not well-formed XML: {what}", "close every element", document.error_line)
