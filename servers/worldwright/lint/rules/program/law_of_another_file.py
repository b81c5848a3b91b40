"""A law of the author's own is not the one in the file that the plan names.

What it does: for each row of `interventions` whose `solver` has a `file`, looks whether that file belongs to the program (it
imports it, and it lies there), and whether `laws=` of `program.main` is handed an object of a class from it. Known is a class that
is called there and stands in the program, or by that name in a file beside it. Silent on a law that comes from any other call or
name, which only a run would tell: the author's process refuses it when it starts.

Why is this bad: the plan was approved with this file, a reader of the stamp opens it, and another law moved the world.

Use instead: `from laws.rubber import Rubber` for `file: laws/rubber.py`, and `laws=[Rubber()]`.
"""

import ast
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path, PurePosixPath

from ....model import companions, syntax
from ....model.companions import CompanionError
from ...case import Case
from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL128"
SEVERITY = "error"
SCOPE = "plan"
_SOLVER = {"name": "rubber", "file": "laws/rubber.py", "shown_by": "band"}
_ROW = {"kind": "solver", "bodies": ["crate"], "law": "at most 5 N", "source": "a table", "solver": _SOLVER}
_PLAN = {"simulation_parameters": {"interventions": [_ROW]}}
_HEAD = "from worldkit import program\nfrom laws.rubber import Rubber\ndef build():\n    return None\n"
GOOD = (
    Case(_HEAD + "program.main(build, duration=3.0, laws=[Rubber(shear=3e5)])\n", _PLAN),
    Case(_HEAD + "band = Rubber()\nprogram.main(build, duration=3.0, laws=(band,))\n", _PLAN),
    Case(_HEAD + "import laws.rubber\nprogram.main(build, duration=3.0, laws=[laws.rubber.soft()])\n", _PLAN),
    Case(_HEAD + "def made():\n    return Rubber()\nprogram.main(build, duration=3.0, laws=[made()])\n", _PLAN),
    Case(_HEAD + "from helpers import made\nprogram.main(build, duration=3.0, laws=[made()])\n", _PLAN),
    Case(_HEAD + "from helpers import band\nprogram.main(build, duration=3.0, laws=[band])\n", _PLAN),
    Case(_HEAD + "import copy\nprogram.main(build, duration=3.0, laws=[copy.copy(Rubber())])\n", _PLAN),
    _HEAD + "program.main(build, duration=3.0)\n",
)
BAD = (
    Case(_HEAD + "program.main(build, duration=3.0)\n", _PLAN),
    Case(_HEAD + "class Own(Rubber):\n    pass\nprogram.main(build, duration=3.0, laws=[Own()])\n", _PLAN),
)
EVIDENCE = Argued("any law steps; that another one was approved, only the plan tells")


def check(program: Program) -> Iterator[Problem]:
    """Check each declared file, and each law that is handed over."""
    if program.plan is None or program.entry is None:
        return
    rows = program.plan.simulation_parameters.interventions
    files = [PurePosixPath(row.solver.file).as_posix() for row in rows if row.solver is not None and row.solver.file]
    modules = {file: file.removesuffix(".py").replace("/", ".") for file in files}
    held = _beside(program)
    for file in files:
        if held is not None and file not in held:
            what = f"the plan declares a law in {file}, which does not belong to the program"
            yield at(program.entry, what, f"write it, and import it: `from {modules[file]} import ...`")
    if not files:
        return
    given = _given(program)
    if given is None:
        return
    came = {node: _comes_from(program, node, held or {}) for node in given}
    for node, full in came.items():
        if full is not None and not any(full.startswith(f"{module}.") for module in modules.values()):
            what = (
                f"`laws=` is handed {ast.unparse(node)[:60]}, which comes from none of the files that the plan declares"
            )
            yield at(node, what, f"hand over a law of {', '.join(files)}, by importing it from there")
    for file, module in modules.items():
        if None not in came.values() and not any(str(full).startswith(f"{module}.") for full in came.values()):
            what = f"the plan declares a law in {file}, and `laws=` is handed none of it"
            yield at(program.entry, what, f"import it (`from {module} import ...`) and give an object of it in `laws=`")


def _beside(program: Program) -> dict[str, bytes] | None:
    """The files that belong to the program, by their paths; None where it lies in no folder."""
    path = Path(program.path).absolute()
    with suppress(OSError, CompanionError):
        return companions.of(path) if path.is_file() else None
    return None


def _given(program: Program) -> list[ast.expr] | None:
    """What stands in `laws=`; None where only a run would tell."""
    assert program.entry is not None
    if any(keyword.arg is None for keyword in program.entry.keywords):
        return None
    node = _behind(program, program.argument(program.entry, "laws"))
    if isinstance(node, ast.List | ast.Tuple):
        return None if any(isinstance(one, ast.Starred) for one in node.elts) else list(node.elts)
    return [] if node is None else [node]


def _behind(program: Program, node: ast.expr | None) -> ast.expr | None:
    """A name's only value, else the expression itself."""
    if not isinstance(node, ast.Name):
        return node
    bound = program.scopes.bound(node)
    return bound[0] if len(bound) == 1 and bound[0] is not None else node


def _comes_from(program: Program, node: ast.expr, beside: dict[str, bytes]) -> str | None:
    """The full path of the class that a law is made of, in the program itself or in a file beside it; None where it is not known."""
    made = _behind(program, node)
    if not isinstance(made, ast.Call):
        return None
    if isinstance(made.func, ast.Name) and any(made.func.id == own.name for own in program.nodes(ast.ClassDef)):
        return f"{Path(program.path).stem}.{made.func.id}"
    full = program.dotted(made.func) or ""
    module, _, name = full.rpartition(".")
    stem = module.replace(".", "/")
    text = beside.get(f"{stem}.py", beside.get(f"{stem}/__init__.py", b""))
    with suppress(ValueError, SyntaxError, RecursionError):
        if any(isinstance(one, ast.ClassDef) and one.name == name for one in syntax.module(text).body):
            return full
    return None
