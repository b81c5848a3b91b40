"""An object of the plan does not appear in the program.

What it does: looks for the name of every scene object and asset instance among the program's strings, f-strings and
MJCF names, or in the files beside it that belong to it; a name may be split between a `prefix` or `suffix` of `attach` and the name in the part attached.

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
    "names = ('ramp', 'crate')\nspec.attach(part, frame=frame, prefix='m')\nname = 'ug'\n",
    'XML = \'<mujoco><worldbody><body name="ramp"/><body name="crate"/><body name="mug"/></worldbody></mujoco>\'\n',
)
BAD = (
    "names = ('ramp', 'crate')\nspec.attach(part, frame=frame, prefix='mu')\nname = 'gg'\n",
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
    before, after = _affixes(program, "prefix"), _affixes(program, "suffix")
    patterns = [_pattern(node) for node in program.nodes(ast.JoinedStr)]
    for name in program.plan.object_names():
        split = any(
            name.startswith(p) and name.endswith(s) and name[len(p) : len(name) - len(s)] in strings
            for p in before
            for s in after
        )
        made = any(p.fullmatch(name) for p in patterns if p is not None)
        if name not in strings and not split and not made and not program.beside(name):
            fix = f'add a body named "{name}", or take the object out of the plan'
            place = getattr(program.build, "lineno", 1)
            yield Problem(f"the plan's object `{name}` is nowhere in the program", fix, place)


def _affixes(program: Program, which: str) -> list[str]:
    """What calls put before (or after) the names in a part: the constants given as `prefix` (`suffix`), and nothing."""
    given = [k.value for call in program.nodes(ast.Call) for k in call.keywords if k.arg == which]
    return ["", *(v.value for v in given if isinstance(v, ast.Constant) and isinstance(v.value, str))]


def _pattern(node: ast.JoinedStr) -> re.Pattern[str] | None:
    """What names an f-string can make; None when it is nothing but a placeholder."""
    parts = [p.value if isinstance(p, ast.Constant) else None for p in node.values]
    if not any(isinstance(part, str) and part.strip("_- ") for part in parts) or len(parts) > 8:
        return None
    return re.compile("".join("[^ ]{0,40}" if part is None else re.escape(str(part)) for part in parts))
