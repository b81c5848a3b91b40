"""Read what a program says of itself in its call of `program.main`, without running it."""

import ast
import inspect
from pathlib import Path
from typing import Any

from . import source
from .program_view import UNKNOWN, Program

MAIN = "worldkit.program.main"


def facts(path: Path, defaults: bool = True) -> dict[str, Any]:
    """Arguments of the one call of `program.main`, by name; with `defaults`, those of today for what is left out.

    An argument that only a run would tell is missing; `control` is the function's name, or None. A program with no such call,
    with several, or with arguments in a list or a mapping tells nothing.
    """
    from worldkit import program as runtime

    view = Program(source.read(path))
    calls = view.calls_by_name.get(MAIN, [])
    if len(calls) != 1:
        return {}
    (call,) = calls
    if any(k.arg is None for k in call.keywords) or any(isinstance(word, ast.Starred) for word in call.args):
        return {}
    parameters = inspect.signature(runtime.main).parameters
    given: dict[str, ast.expr] = dict(zip(parameters, call.args, strict=False))
    given |= {str(keyword.arg): keyword.value for keyword in call.keywords}
    found = {n: p.default for n, p in parameters.items() if defaults and n not in given and p.default is not p.empty}
    for name, node in given.items():
        value = _called(view, node) if name == "control" else view.value(node)
        if value is not UNKNOWN:
            found[name] = value
    return found


def _called(view: Program, node: ast.expr) -> Any:
    """The name of a function that the program defines, None for none at all."""
    if isinstance(node, ast.Constant):
        return node.value
    defined = {f.name for f in view.nodes(ast.FunctionDef)}
    return node.id if isinstance(node, ast.Name) and node.id in defined else UNKNOWN
