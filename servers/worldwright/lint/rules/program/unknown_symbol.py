"""A name is used that the installed MuJoCo does not have.

What it does: resolves every `mujoco.…` attribute, enum value, and every attribute or method of an object whose class is
known (an `MjSpec`, a body it returned, `MjModel`, `MjData` …) against the installed build.

Why is this bad: the program fails with an AttributeError at that line, or assigns to an attribute that cannot exist.
MuJoCo 4.0 is newer than most memories of it: 3.x names were renamed and removed.

Use instead: the nearest existing name, or what the changelog's migration says; `worldwright retrieve symbol NAME` shows
the signature and the manual's entry.
"""

import ast
from collections.abc import Iterator

from ....simulator import changelog
from ...bound_names import respelled
from ...harm import Raises
from ...problem import Edit, Problem, at
from ...program_view import Program

CODE = "WL101"
ABOUT = "names"
LOOK_UP = True
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "import mujoco as mj\nspec = mj.MjSpec()\nball = spec.worldbody.add_body(name='ball')\nball.add_freejoint()\n",
    "import mujoco\nkind = mujoco.mjtGeom.mjGEOM_BOX\nmujoco.viewer.launch_passive\n",
    "import mujoco\nif hasattr(mujoco, 'mj_future'):\n    mujoco.mj_future()\n",
    "from mujoco import MjSpec\nMjSpec().option.timestep = 0.001\n",
    "class mujoco:\n    anything = 1\nmujoco.anything\n",
)
BAD = (
    "import mujoco\nmujoco.mj_stepp\n",
    "import mujoco as mj\nkind = mj.mjtGeom.mjGEOM_CUBE\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.worldbody.add_box(size=[1, 1, 1])\n",
    "import mujoco\nspec = mujoco.MjSpec()\nspec.option.time_step = 0.001\n",
    "from mujoco import mju_rayFlex\n",
    "import mujoco\ndef control(model: mujoco.MjModel, data: mujoco.MjData):\n    return data.efc_diagApprox\n",
    "from worldkit import scene\nspec = scene.new('a', time_step=0.001)\nspec.add_body()\n",
)
FIXED = (
    None,
    None,
    None,
    "import mujoco\nspec = mujoco.MjSpec()\nspec.option.timestep = 0.001\n",
    None,
    "import mujoco\ndef control(model: mujoco.MjModel, data: mujoco.MjData):\n    return data.efc_diagA\n",
)
EVIDENCE = Raises(without=(5,), good=False)


def check(program: Program) -> Iterator[Problem]:
    """Check imports, then dotted names, then members of inferred classes."""
    yield from _imports(program)
    for node in program.nodes(ast.Attribute):
        if program.is_guarded(node):
            continue
        full = program.dotted(node)
        if full is not None:
            # `a.b.c` is three nodes: each is judged at its own level, so that the first missing part is reported.
            yield from _dotted(program, node, full)
        elif (owner := program.type_of(node.value)) is not None and not node.attr.startswith("__"):
            yield from _member(program, node, owner, node.attr)


def _imports(program: Program) -> Iterator[Problem]:
    for node in program.nodes(ast.ImportFrom):
        if node.level == 0 and node.module and node.module.split(".")[0] == "mujoco" and not program.is_guarded(node):
            for alias in node.names:
                if alias.name != "*":
                    yield from _dotted(program, node, f"{node.module}.{alias.name}")
    for node in program.nodes(ast.Import):
        for alias in node.names:
            if alias.name.startswith("mujoco.") and not program.is_guarded(node):
                yield from _dotted(program, node, alias.name)


def _dotted(program: Program, node: ast.AST, full: str) -> Iterator[Problem]:
    parts = full.split(".")
    if parts[0] != "mujoco" or len(parts) not in (2, 3) or parts[-1].startswith("__"):
        return
    table = program.symbols
    entry = table.top(parts[1])
    if len(parts) == 2:
        if entry is None and not parts[1].startswith("_"):
            yield _missing(program, node, full, parts[1], None)
        return
    if entry is None:
        return
    if entry["kind"] in ("class", "enum"):
        if table.member(parts[1], parts[2]) is None:
            yield _missing(program, node, full, parts[2], parts[1])
    elif entry["kind"] == "module" and table.in_submodule(parts[1], parts[2]) is False:
        yield _missing(program, node, full, parts[2], None)


def _member(program: Program, node: ast.AST, owner: str, name: str) -> Iterator[Problem]:
    table = program.symbols
    if table.names[owner]["kind"] == "enum" or table.names[owner].get("open"):
        return  # an enum's values carry `.name` and `.value`; a Python class's instances carry what they please
    if table.member(owner, name) is None:
        yield _missing(program, node, f"{owner.lstrip('_')}.{name}", name, owner)


def _missing(program: Program, node: ast.AST, shown: str, name: str, owner: str | None) -> Problem:
    table = program.symbols
    if shown == "mujoco.mjx":
        return at(node, "`mujoco.mjx` is a distribution of its own and is not installed", "pip install mujoco-mjx")
    near = table.nearest(name, owner)
    became = changelog.advice(name)
    hints = []
    if became:
        hints.append(became)
    if near:
        prefix = f"{owner.lstrip('_')}." if owner else "mujoco."
        hints.append("nearest: " + ", ".join(f"`{prefix}{n}`" for n in near))
    elif owner is None and name in table.enum_of_value:
        hints.append(f"it is a value of `mujoco.{table.enum_of_value[name]}`")
    elif owner is not None and name in table.owners:
        hints.append("it is a member of " + ", ".join(f"`{o}`" for o in table.owners[name][:4]))
    fix = "; ".join(hints) or f"look it up: worldwright retrieve symbol {name}"
    return at(node, f"MuJoCo {table.version} has no `{shown}`", fix, edit=_edit(program, node, name, owner))


def _edit(program: Program, node: ast.AST, name: str, owner: str | None) -> Edit | None:
    """Another spelling of the same name, or the name that the changelog says it has now."""
    table = program.symbols
    entry = table.names.get(owner, {}) if owner else {}
    known = set(entry.get("members", ())) if owner else {n for n, e in table.names.items() if not e.get("private")}
    right = respelled(name, known) or changelog.renamed(name)
    if right is None or right not in known or not isinstance(node, ast.Attribute):
        return None
    whole = program.edit(node, right)
    return Edit(whole.end_line, whole.end_column - len(name), whole.end_line, whole.end_column, right)
