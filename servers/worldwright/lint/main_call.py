"""Read what a program says of itself in its call of `program.main`, without running it."""

import ast
import inspect
from pathlib import Path
from typing import Any

from ..model import companions
from . import source
from .program_view import UNKNOWN, Program

MAIN = "worldkit.program.main"
MODULE = MAIN.rpartition(".")[0]
ROUNDABOUT = frozenset(("getattr", "eval", "exec", "__import__", "importlib", "globals", "locals", "vars", "runpy"))
"""Names by which a program reaches what it does not name; and attributes that lead there."""
WAYS = frozenset(("modules", "import_module", "attrgetter", "methodcaller"))
PLAIN = frozenset(("__name__", "__file__", "__future__"))


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


def sole(path: Path) -> bool:
    """Whether the one call of `program.main` is made whenever the program is run, and its text shows no other way to make one.

    A call in a function, a branch or a loop may be a decoy for another, which comes by `getattr` or from a file beside it.
    """
    view = Program(source.read(path))
    calls = view.calls_by_name.get(MAIN, [])
    if len(calls) != 1 or companions.of(path):
        return False
    (call,) = calls
    names = {node.id for node in view.nodes(ast.Name)}
    names |= {part for node in view.nodes(ast.Import, ast.ImportFrom) for part in _imported(node)}
    inside = {node.attr for node in view.nodes(ast.Attribute)}
    if names & ROUNDABOUT or (names | inside) & WAYS or any(n.startswith("__") for n in (names | inside) - PLAIN):
        return False
    own = {*ast.walk(call.func)}
    ways = [node for node in view.nodes(ast.Name, ast.Attribute) if node not in own]
    return _at_once(view, call) and not any(_leads(view.dotted(node) or "") for node in ways)


def _imported(node: ast.Import | ast.ImportFrom) -> list[str]:
    """The words of an import; `*`, which binds names that the text does not show, stands for a way round."""
    words = [alias.name for alias in node.names]
    if "*" in words:
        return ["globals"]
    return [part for word in (*words, getattr(node, "module", None) or "") for part in word.split(".")]


def _leads(full: str) -> bool:
    """Whether a name leads to `program.main`: to it, to its module, or to the package around it alone."""
    return full == MAIN.partition(".")[0] or full == MODULE or full.startswith(f"{MODULE}.")


def _at_once(view: Program, call: ast.Call) -> bool:
    """Whether a call is a statement of the module itself, or of its `if __name__ == "__main__"`."""
    around = [node for node in view.ancestors(call) if isinstance(node, ast.stmt)]
    return len(around) == 1 or (len(around) == 2 and ast.unparse(getattr(around[1], "test", around[1])) in NAMED)


NAMED = ("__name__ == '__main__'", "'__main__' == __name__")


def _called(view: Program, node: ast.expr) -> Any:
    """The name of a function that the program defines, None for none at all."""
    if isinstance(node, ast.Constant):
        return node.value
    defined = {f.name for f in view.nodes(ast.FunctionDef)}
    return node.id if isinstance(node, ast.Name) and node.id in defined else UNKNOWN
