"""An object of the plan does not appear in the program.

What it does: looks for the name of every scene object and asset instance among the program's strings, f-strings and
MJCF names.

Why is this bad: the world lacks something the user approved, and every expectation, camera subject and placement that
names it has nothing to hold on to.

Use instead: a body with exactly the plan's name, e.g. `bodies.box(spec, "crate", …)` or
`assets.add(spec, "mug", name="mug", …)`.
"""

import ast
import re
from collections.abc import Iterator

from ...case import Case
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL123"
SEVERITY = "error"
SCOPE = "plan"
TWO_MUGS = {"assets": [{"name": "mug", "filename": "mug", "count": 2}]}
GOOD = (
    "names = ('ramp', 'crate', 'mug')\n",
    Case("for i in range(2):\n    name = f'mug_{i + 1}'\nparts = ['ramp', 'crate']\n", TWO_MUGS),
    'XML = \'<mujoco><worldbody><body name="ramp"/><body name="crate"/><body name="mug"/></worldbody></mujoco>\'\n',
)
BAD = (
    "names = ('ramp', 'mug')\n",
    "names = ('ramp', 'crate_', 'mug')  # crate\n",
    Case("names = ('ramp', 'crate', 'mug_1')\n", TWO_MUGS),
)
EVIDENCE = Argued("no run shows an absence; what the plan promises of the object cannot be measured")


def check(program: Program) -> Iterator[Problem]:
    """Check every object name of the plan."""
    if program.plan is None:
        return
    # A name in a docstring or among a camera's subjects is not the object; but a name that stands nowhere else is rare,
    # and only a run could tell a subject from a name. Docstrings are left out.
    docstrings = {
        id(s.value)
        for n in (*program.nodes(ast.Module), *program.nodes(ast.FunctionDef))
        for s in n.body[:1]
        if isinstance(s, ast.Expr)
    }
    strings = {n.value for n in program.nodes(ast.Constant) if isinstance(n.value, str) and id(n) not in docstrings}
    strings |= {tag.attributes["name"] for tag in program.tags() if "name" in tag.attributes}
    patterns = [_pattern(node) for node in program.nodes(ast.JoinedStr)]
    for name in program.plan.object_names():
        if name not in strings and not any(p.fullmatch(name) for p in patterns if p is not None):
            fix = f'add a body named "{name}", or take the object out of the plan'
            place = getattr(program.build, "lineno", 1)
            yield Problem(f"the plan's object `{name}` is nowhere in the program", fix, place)


def _pattern(node: ast.JoinedStr) -> re.Pattern[str] | None:
    """What names an f-string can make; None when it is nothing but a placeholder."""
    parts = [p.value if isinstance(p, ast.Constant) else None for p in node.values]
    if not any(isinstance(part, str) and part.strip("_- ") for part in parts) or len(parts) > 8:
        return None
    return re.compile("".join("[^ ]{0,40}" if part is None else re.escape(str(part)) for part in parts))
