"""Reduce the source of a program that drives its world to what decides the motion, without the placing of cameras.

Control code and laws may read anything, so what counts is the syntax tree of the whole file, and of every module beside it.
Left out are docstrings, comments, layout, and statements `cameras.add(…)` and `lights.add(…)` whose arguments are written out
as plain values. Where the rest mentions cameras, lights, colours or a way to reach them by another name, or imports more than
arithmetic, nothing is promised of a world that looks otherwise (`drive_source`); of one that is the same byte for byte, the
same code is (`same_source`).

It catches nobody: it spares a pass after a repair of cameras. To ask `control` again beside the engine would tell as much of any
change, and costs most of a pass; acceptance does it, whatever is promised here.
"""

import ast
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import PurePath

IMPORTS = {"__future__", "mujoco", "numpy", "worldkit", "math", "typing", "collections", "dataclasses", "functools"}
SEEING = re.compile(
    r"n?cam(era)?s?|cam_\w*|\w*_cam\w*|n?lights?|light_\w*|n?mat|mat_\w*|\w*_matid|\w*rgba|n?tex|tex_\w*|vis|visual|"
    r"n?skins?|skin_\w*|n?texts?|text_\w*|names|names_map|paths|signature|stat|nbuffer|\w*castshadow|__\w+__|"
    r"mj_(save|size|copy|print|ray|multiRay|cam)\w*|mjv_\w+|mjr_\w+|Renderer"
)
"""Names through which a program could see a look or a camera."""
BY_ANOTHER_NAME = {"getattr", "setattr", "vars", "dir", "eval", "exec", "compile", "globals", "locals", "open"}
"""Built-in functions that reach the names of SEEING without writing them."""
USUAL = {"__init__", "__post_init__", "__call__", "__len__", "__iter__", "__enter__", "__exit__"}
"""Methods that a class has or calls, and through which nothing else is reached."""
UNSEEN = {"cameras.add", "lights.add"}
"""What only places a camera, or states the light."""
OWN_TEXT = re.compile(r"__doc__|__file__|\binspect\b|\blinecache\b|\bopen\b|read_(text|bytes)|loadtxt|getsource")
"""Where code may read its own text, every character of it counts."""
PLAN = "plan.md"
"""What lies beside the program of a confined process and belongs to no hash: code that reads it is promised nothing."""


@dataclass(frozen=True)
class Beside:
    """All that a program runs with besides its own file."""

    modules: Mapping[str, str] = field(default_factory=dict)
    """The text of each module, by its path below the program's folder."""
    data: str = ""
    """A hash over the other files; empty when there are none."""


def drive_source(source: str | None, control: str, beside: Beside | None = None) -> str:
    """The part of the program that decides how it drives; empty where a look might decide, too.

    Args:
        source: text of the program's file.
        control: name of a plain function of that file; empty where only laws answer.
        beside: what the program runs with; None: nothing is known of it, and it may import nothing of its own.
    """
    texts = _texts(source, beside)
    own = {PurePath(name).parts[0].removesuffix(".py") for name in texts if name}
    own |= {""} if beside else set()
    found = {}
    for name, text in texts.items():
        tree = _tree(text)
        if tree is None or not _blind(tree, IMPORTS | own):
            return ""
        if not name and control and control not in {n.name for n in tree.body if isinstance(n, ast.FunctionDef)}:
            return ""
        found[name] = ast.dump(tree)
    return _joined(found, beside)


def same_source(source: str | None, beside: Beside | None) -> str:
    """The same for a world that is the same byte for byte, where what it looks like cannot differ; empty: nothing is promised.

    Args:
        source: text of the program's file.
        beside: what the program runs with; None: nothing is known of it.
    """
    texts = _texts(source, beside)
    if beside is None:
        return ""
    whole = any(map(OWN_TEXT.search, texts.values()))
    found = {}
    for name, text in texts.items():
        tree = None if whole else _tree(text)
        found[name] = text if tree is None else ast.dump(tree)
    return "" if any(PLAN in text for text in found.values()) else _joined(found, beside)


def _texts(source: str | None, beside: Beside | None) -> dict[str, str]:
    """Every text that counts, the program's own under an empty name; none without that."""
    return {} if source is None else {"": source, **(beside.modules if beside else {})}


def _joined(found: dict[str, str], beside: Beside | None) -> str:
    if not beside or not (beside.modules or beside.data):
        return "".join(found.values())
    return repr((sorted(found.items()), beside.data)) if found else ""


def _tree(text: str) -> ast.Module | None:
    try:
        tree = _Unseen().visit(ast.parse(text))
    except (SyntaxError, ValueError, RecursionError):
        return None
    return tree if isinstance(tree, ast.Module) else None


def _blind(tree: ast.Module, allowed: set[str]) -> bool:
    """Whether nothing in it could see a look or a camera."""
    return all(_harmless(node, allowed) for node in ast.walk(tree))


def _harmless(node: ast.AST, allowed: set[str]) -> bool:
    if isinstance(node, ast.Import):
        return all(alias.name.split(".")[0] in allowed for alias in node.names)
    if isinstance(node, ast.ImportFrom):
        return ("" if node.level else (node.module or "").split(".")[0]) in allowed
    if isinstance(node, ast.Name) and node.id != "__name__":
        return node.id not in BY_ANOTHER_NAME and not SEEING.fullmatch(node.id)
    if isinstance(node, ast.Attribute):
        return node.attr in USUAL or not SEEING.fullmatch(node.attr)
    return True


class _Unseen(ast.NodeTransformer):
    """Removes docstrings, the placing of cameras, and the stated light."""

    def visit_Expr(self, node: ast.Expr) -> ast.AST | None:
        """Remove a statement that is a text, places a camera or states the light."""
        value = node.value
        if isinstance(value, ast.Constant):
            return ast.copy_location(ast.Pass(), node)
        if isinstance(value, ast.Call) and ast.unparse(value.func) in UNSEEN:
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
