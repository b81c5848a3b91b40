"""What `worldkit` offers, read from its sources without importing it: the API that programs are written against."""

import ast
import importlib.util
from dataclasses import dataclass
from functools import cache
from pathlib import Path

from ..model import syntax
from ..simulator.inventory import bound


@dataclass(frozen=True)
class Callee:
    """How a function or class of worldkit may be called."""

    parameters: tuple[str, ...]
    open: bool
    """It takes any keyword (`**common`), so keywords cannot be checked."""
    returns: str
    """Its return annotation as written, e.g. `mujoco.MjSpec`."""


@cache
def folder() -> Path | None:
    """Where worldkit is installed."""
    spec = importlib.util.find_spec("worldkit")
    locations = list(spec.submodule_search_locations or ()) if spec else []
    return Path(locations[0]) if locations else None


def modules() -> list[str]:
    """Its public modules."""
    root = folder()
    if root is None:
        return []
    files = [p.stem for p in root.glob("*.py")] + [p.parent.name for p in root.glob("*/__init__.py")]
    return sorted(name for name in files if not name.startswith("_"))


def names(module: str) -> list[str] | None:
    """What `worldkit.<module>` binds; None when there is no such module, or only importing it would tell."""
    path = _file(module)
    if path is None:
        return None
    try:
        found = _top_names(path, path.stat().st_mtime_ns)
    except (OSError, SyntaxError, ValueError):
        return None
    if found is not None and path.name == "__init__.py":
        inside = {p.stem for p in path.parent.glob("*.py")} | {p.parent.name for p in path.parent.glob("*/__init__.py")}
        found = sorted({*found, *(name for name in inside if not name.startswith("_"))})
    return found


@cache
def _top_names(path: Path, _changed: int) -> list[str] | None:
    return bound(syntax.module(path.read_text(encoding="utf-8")), path.name == "__init__.py")


def callee(module: str, name: str) -> Callee | None:
    """The signature of `worldkit.<module>.<name>`, following one re-export; None when it is not a plain function."""
    path = _file(module)
    if path is None:
        return None
    tree = _parse(path, path.stat().st_mtime_ns)
    for node in tree.body:
        if isinstance(node, ast.FunctionDef) and node.name == name:
            return _callee(node)
        if isinstance(node, ast.ImportFrom) and node.level == 1 and path.name == "__init__.py":
            for alias in node.names:
                if (alias.asname or alias.name) == name and node.module:
                    return callee(f"{module}.{node.module}", alias.name)
    return None


def _callee(node: ast.FunctionDef) -> Callee:
    a = node.args
    parameters = tuple(p.arg for p in [*a.posonlyargs, *a.args, *a.kwonlyargs])
    returns = ""
    if isinstance(node.returns, ast.Constant) and isinstance(node.returns.value, str):
        returns = node.returns.value
    elif node.returns is not None:
        returns = ast.unparse(node.returns)
    return Callee(parameters, a.kwarg is not None, returns)


def _file(module: str) -> Path | None:
    root = folder()
    if root is None:
        return None
    base = root.joinpath(*module.split("."))
    for path in (base.with_suffix(".py"), base / "__init__.py"):
        if path.is_file():
            return path
    return None


@cache
def _parse(path: Path, _modified_ns: int) -> ast.Module:
    try:
        return syntax.module(path.read_text(encoding="utf-8"))
    except (OSError, SyntaxError, ValueError):
        return ast.Module([], [])
