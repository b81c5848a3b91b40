"""Find what the program calls a value: the names to which an expression on a line is given."""

import ast
import re
from functools import cache
from typing import Any

import made_worlds

LINEAR = re.compile(
    r"(?<![a-z])(lin|linear|vel|velocity|speed|v|vx|vxyz|xdot|trans|translational|vlin|linvel)(?![a-z])"
)
ANGULAR = re.compile(r"ang|omega|rot|gyro|rate|spin|turn|(?<![a-z])w(?![a-z])|rpm|twist|yaw|pitch|roll")
FORCE = re.compile(r"force|thrust|push|pull|wind|gust|drag|lift|weight|buoyan|(?<![a-z])f[xyz]?(?![a-z])")
TORQUE = re.compile(r"torq|moment|couple|(?<![a-z])tau(?![a-z])")


def words(node: Any) -> str:
    """All names and text in an expression, as lower-case words."""
    found = []
    for part in ast.walk(node):
        if isinstance(part, ast.Name):
            found.append(part.id)
        elif isinstance(part, ast.Attribute):
            found.append(part.attr)
        elif isinstance(part, ast.Constant) and isinstance(part.value, str):
            found.append(part.value)
    return re.sub(r"[_\W]+", " ", " ".join(found)).lower()


@cache
def _tree() -> tuple[ast.AST, dict[ast.AST, ast.AST]]:
    tree = ast.parse("\n".join(made_worlds.TEXT))
    return tree, {child: node for node in ast.walk(tree) for child in ast.iter_child_nodes(node)}


def given_to(node: ast.AST) -> str:
    """The words that name what an expression becomes: a target, a key, a keyword, or the function that returns it."""
    above = _tree()[1]
    inner, outer = node, above.get(node)
    while outer is not None:
        if isinstance(outer, ast.Dict) and inner in outer.values:
            key = outer.keys[outer.values.index(inner)]
            return words(key) if key is not None else ""
        if isinstance(outer, ast.keyword):
            return re.sub("_", " ", outer.arg or "").lower()
        if isinstance(outer, ast.Tuple | ast.List) and isinstance(place := above.get(outer), ast.Assign):
            target = place.targets[0]
            if isinstance(target, ast.Tuple | ast.List) and len(target.elts) == len(outer.elts):
                return words(target.elts[outer.elts.index(inner)])  # type: ignore[arg-type]
            return ""
        if isinstance(outer, ast.Tuple | ast.List | ast.BinOp):
            return ""
        if isinstance(outer, ast.Assign):
            return " ".join(words(t) for t in outer.targets)
        if isinstance(outer, ast.AnnAssign | ast.AugAssign):
            return words(outer.target)
        if isinstance(outer, ast.Return):
            while outer is not None and not isinstance(outer, ast.FunctionDef):
                outer = above.get(outer)
            return re.sub("_", " ", outer.name).lower() if isinstance(outer, ast.FunctionDef) else ""
        if isinstance(outer, ast.stmt):
            return ""
        inner, outer = outer, above.get(outer)
    return ""


@cache
def halves(line: int, second: bool) -> tuple[str, ...]:
    """The names that a line gives to the first (or second) three of six numbers."""
    found = []
    for node in ast.walk(_tree()[0]):
        if isinstance(node, ast.Subscript) and node.lineno == line and _half(node.slice) == second:
            found.append(given_to(node))
    return tuple(found)


def _half(key: Any) -> bool | None:
    """False for `[:3]`, True for `[3:]` and `[3:6]`, None for anything else."""
    part = key.elts[-1] if isinstance(key, ast.Tuple) and key.elts else key
    if not isinstance(part, ast.Slice):
        return None
    first, last = (n.value if isinstance(n, ast.Constant) else None for n in (part.lower, part.upper))
    if first in (None, 0) and last == 3:
        return False
    return True if first == 3 and last in (None, 6) else None


@cache
def innermost(line: int, kind: type = ast.stmt) -> Any:
    """The innermost statement (or definition) of a kind around a line, or None."""
    found = [n for n in ast.walk(_tree()[0]) if isinstance(n, kind) and n.lineno <= line <= (n.end_lineno or n.lineno)]
    return max(found, key=lambda n: (n.lineno, -(n.end_lineno or 0)), default=None)


def function_at(line: int) -> str:
    """The name of the innermost function around a line, in lower case."""
    found = innermost(line, ast.FunctionDef)
    return found.name.lower() if found is not None else ""


def around(line: int) -> str:
    """The text of the innermost function around a line, or of the lines close to it."""
    found = innermost(line, ast.FunctionDef)
    first, last = (found.lineno, found.end_lineno) if found is not None else (max(line - 12, 1), line + 12)
    return "\n".join(made_worlds.TEXT[first - 1 : last])


@cache
def column(line: int) -> str:
    """The name that a line gives to its one subscript that ends in the number 0, or nothing."""
    found = [
        n for n in ast.walk(_tree()[0])
        if isinstance(n, ast.Subscript) and n.lineno == line and isinstance(n.slice, ast.Tuple) and n.slice.elts
        and isinstance(n.slice.elts[-1], ast.Constant) and n.slice.elts[-1].value == 0
    ]  # fmt: skip
    return given_to(found[0]) if len(found) == 1 else ""
