"""A simulator function is called with a keyword it does not take.

What it does: compares the keywords of every call of a MuJoCo function, constructor or `MjSpec` method (`add_geom`,
`add_joint` …) with the parameters of the installed build.

Why is this bad: the call fails with a TypeError. MJCF attribute names and `MjSpec` field names differ (`user` and
`userdata`, `mesh` and `meshname`), which is easy to mix up.

Use instead: the nearest parameter, named in the finding.
"""

import ast
from collections.abc import Iterator
from difflib import get_close_matches

from ....simulator import changelog
from ...bound_names import respelled
from ...harm import Raises
from ...problem import Edit, Problem, at
from ...program_view import Program

CODE = "WL102"
ABOUT = "names"
LOOK_UP = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    (
        "import mujoco\nspec = mujoco.MjSpec()\nb = spec.worldbody.add_body(name='b', pos=[0, 0, 1])\n"
        "b.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[1, 1, 1], friction=[1, 0, 0])\n"
    ),
    "import mujoco\nmujoco.Renderer(model=None, height=480, width=640)\n",
    "import mujoco\nspec = mujoco.MjSpec()\nextra = {'mass': 1}\nspec.worldbody.add_geom(**extra)\n",
)
BAD = (
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(kind=1)\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_body(position=[0, 0, 1])\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.add_mesh(name='m', filename='m.stl')\n",
    "import mujoco as mj\nb = mj.MjSpec().worldbody.add_body()\nb.add_geom(mesh='m')\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(con_type=1)\n",
)
FIXED = (None, None, None, None, "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_geom(contype=1)\n")
EVIDENCE = Raises(good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check every call whose target is known."""
    table = program.symbols
    for call in program.nodes(ast.Call):
        if not call.keywords:
            continue
        shown, entry = _target(program, call)
        if entry is None or "parameters" not in entry:
            continue
        known = entry["parameters"]
        for keyword in call.keywords:
            if keyword.arg is None or keyword.arg in known:
                continue
            near = get_close_matches(keyword.arg, known, n=3, cutoff=0.5)
            near = near or [p for p in known if keyword.arg in p or p in keyword.arg]
            became = changelog.advice(keyword.arg)
            hints = ([became] if became else []) + (["nearest: " + ", ".join(f"`{n}`" for n in near)] if near else [])
            fix = "; ".join(hints) or "it takes: " + ", ".join(known[:30])
            right = respelled(keyword.arg, known)
            edit = None
            if right is not None and right not in [k.arg for k in call.keywords]:
                start = program.edit(keyword, "")
                edit = Edit(start.line, start.column, start.line, start.column + len(keyword.arg), right)
            yield at(keyword.value, f"`{shown}` takes no `{keyword.arg}` in MuJoCo {table.version}", fix, edit=edit)


def _target(program: Program, call: ast.Call):
    table = program.symbols
    full = program.dotted(call.func)
    if full is not None:
        parts = full.split(".")
        if parts[0] != "mujoco":
            return "", None
        if len(parts) == 2:
            entry = table.top(parts[1])
            if entry is not None and entry["kind"] == "class":
                return parts[1], entry["members"].get("__init__")
            return parts[1], entry if entry and entry["kind"] == "function" else None
        if len(parts) == 3:
            return ".".join(parts[1:]), table.member(parts[1], parts[2])
        return "", None
    if isinstance(call.func, ast.Attribute):
        owner = program.type_of(call.func.value)
        if owner is not None:
            return f"{owner}.{call.func.attr}", table.member(owner, call.func.attr)
    return "", None
