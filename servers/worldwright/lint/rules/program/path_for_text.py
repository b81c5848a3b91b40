"""A file name is given where MJCF text is wanted, or text where a file name is.

What it does: looks at literal arguments of `MjModel.from_xml_string`, `MjModel.from_xml_path`, `MjSpec.from_string` and
`MjSpec.from_file`.

Why is this bad: the engine reads the file name as XML, and fails with a parse error that does not say so.

Use instead: `from_xml_path` and `from_file` for files, `from_xml_string` and `from_string` for text.
"""

import ast
from collections.abc import Iterator

from ...harm import Raises
from ...problem import Edit, Problem, at
from ...program_view import Program

CODE = "WL117"
ABOUT = "signatures"
SEVERITY = "error"
SCOPE = "any"
GOOD = ("import mujoco\nm = mujoco.MjModel.from_xml_string('<mujoco/>')\n",)
BAD = (
    "import mujoco\nm = mujoco.MjModel.from_xml_string('scene.xml')\n",
    "import mujoco\nm = mujoco.MjModel.from_xml_path('<mujoco/>')\n",
    "import mujoco\ns = mujoco.MjSpec.from_string('robot/arm.mjcf')\n",
)
FIXED = (
    "import mujoco\nm = mujoco.MjModel.from_xml_path('scene.xml')\n",
    "import mujoco\nm = mujoco.MjModel.from_xml_string('<mujoco/>')\n",
    "import mujoco\ns = mujoco.MjSpec.from_file('robot/arm.mjcf')\n",
)
EVIDENCE = Raises()
OTHER = {
    "from_xml_string": "from_xml_path",
    "from_xml_path": "from_xml_string",
    "from_string": "from_file",
    "from_file": "from_string",
}
SUFFIXES = (".xml", ".mjcf", ".urdf", ".mjb", ".mjz")


def check(program: Program) -> Iterator[Problem]:
    """Check the first argument of each call."""
    for full, call in program.calls("mujoco.MjModel.", "mujoco.MjSpec."):
        method = full.rsplit(".", 1)[-1]
        given = program.value(call.args[0]) if method in OTHER and call.args else None
        if not isinstance(given, str):
            continue
        text = given.lstrip().startswith("<")
        path = given.strip().lower().endswith(SUFFIXES) and "<" not in given
        if (method in ("from_xml_string", "from_string") and path) or (
            method in ("from_xml_path", "from_file") and text
        ):
            what = "a file name" if path else "text"
            edit = _renamed(program, call, OTHER[method])
            yield at(call, f"{method} is given {what}", f"call {OTHER[method]}", edit=edit)


def _renamed(program: Program, call: ast.Call, name: str) -> Edit | None:
    whole = program.edit(call.func, name)
    start = whole.end_column - len(call.func.attr) if isinstance(call.func, ast.Attribute) else 0
    return Edit(whole.end_line, start, whole.end_line, whole.end_column, name) if start > 0 else None
