"""Reduce the source of a program that drives its world to what decides the motion, without the placing of cameras.

Control code may read anything, so what counts is the syntax tree of the whole file. Left out are docstrings, comments,
layout, and statements `cameras.add(…)` whose arguments are written out as plain values. Where the rest mentions cameras,
lights, colours or a way to reach them by another name, or imports more than arithmetic, nothing is promised.

It catches nobody: it spares a pass after a repair of cameras. To ask `control` again beside the engine would tell as much of any
change, and costs most of a pass; acceptance does it, whatever is promised here.
"""

import ast
import re

IMPORTS = {"__future__", "mujoco", "numpy", "worldkit", "math", "typing", "collections", "dataclasses", "functools"}
SEEING = re.compile(
    r"n?cam(era)?s?|cam_\w*|\w*_cam\w*|n?lights?|light_\w*|n?mat|mat_\w*|\w*_matid|\w*rgba|n?tex|tex_\w*|vis|visual|"
    r"n?skins?|skin_\w*|n?texts?|text_\w*|names|names_map|paths|signature|stat|nbuffer|\w*castshadow|__\w+__|"
    r"mj_(save|size|copy|print|ray|multiRay|cam)\w*|mjv_\w+|mjr_\w+|Renderer"
)
"""Names through which a program could see a look or a camera."""
BY_ANOTHER_NAME = {"getattr", "setattr", "vars", "dir", "eval", "exec", "compile", "globals", "locals", "open"}
"""Built-in functions that reach the names of SEEING without writing them."""


def drive_source(source: str | None, control: str) -> str:
    """The part of the program that decides how it drives; empty where a look might decide, too.

    Args:
        source: text of the program's file.
        control: name of a plain function of that file.
    """
    if source is None:
        return ""
    try:
        tree = _Unseen().visit(ast.parse(source))
    except (SyntaxError, ValueError, RecursionError):
        return ""
    functions = {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}
    if control not in functions:
        return ""
    for node in ast.walk(tree):
        names: list[str] = []
        if isinstance(node, ast.Import):
            if any(alias.name.split(".")[0] not in IMPORTS for alias in node.names):
                return ""
        elif isinstance(node, ast.ImportFrom):
            if node.level or (node.module or "").split(".")[0] not in IMPORTS:
                return ""
        elif isinstance(node, ast.Name) and node.id != "__name__":
            if node.id in BY_ANOTHER_NAME:
                return ""
            names = [node.id]
        elif isinstance(node, ast.Attribute):
            names = [node.attr]
        if any(SEEING.fullmatch(name) for name in names):
            return ""
    return ast.dump(tree)


class _Unseen(ast.NodeTransformer):
    """Removes docstrings and the placing of cameras."""

    def visit_Expr(self, node: ast.Expr) -> ast.AST | None:
        """Remove a statement that is a text or places a camera."""
        value = node.value
        if isinstance(value, ast.Constant):
            return ast.copy_location(ast.Pass(), node)
        if isinstance(value, ast.Call) and ast.unparse(value.func) == "cameras.add":
            given = [*value.args[1:], *(keyword.value for keyword in value.keywords)]
            if value.args and isinstance(value.args[0], ast.Name) and all(map(_plain, given)):
                return ast.copy_location(ast.Pass(), node)
        return node


def _plain(node: ast.expr) -> bool:
    """Whether an argument is written out as a plain value."""
    try:
        ast.literal_eval(node)
    except (ValueError, TypeError, SyntaxError, MemoryError, RecursionError):
        return False
    return True
