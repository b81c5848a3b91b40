"""Values that are known without running anything: literals, arithmetic, and names bound once to them."""

import ast
import math
import operator
from collections.abc import Callable
from typing import Any, Final


class _Unknown:
    def __bool__(self) -> bool:
        return False

    def __repr__(self) -> str:
        return "UNKNOWN"


UNKNOWN: Final = _Unknown()
"""This value depends on something that only a run would tell."""

_BINARY: dict[type[ast.operator], Callable[[Any, Any], Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: operator.pow,
}
_NAMED = {"pi": math.pi, "tau": math.tau, "e": math.e, "inf": math.inf}
_CALLS: dict[str, Callable[..., Any]] = {
    "radians": math.radians,
    "deg2rad": math.radians,
    "degrees": math.degrees,
    "rad2deg": math.degrees,
    "sqrt": math.sqrt,
    "sin": math.sin,
    "cos": math.cos,
    "tan": math.tan,
    "float": float,
    "int": int,
    "abs": abs,
    "min": min,
    "max": max,
    "round": round,
}
_WRAPPERS = {"array", "asarray", "tuple", "list"}


class Folder:
    """Folds expressions; `binding` gives the one expression a name stands for, `dotted` a name's full path."""

    def __init__(
        self,
        binding: Callable[[ast.Name], ast.expr | None],
        dotted: Callable[[ast.AST], str | None],
    ) -> None:
        self.binding = binding
        self.dotted = dotted

    def value(self, node: ast.AST | None, depth: int = 0) -> Any:
        """The value of an expression: a number, string, bool, None, tuple or dict; or `UNKNOWN`."""
        if node is None or depth > 40:
            return UNKNOWN
        if isinstance(node, ast.Constant):
            return node.value
        if isinstance(node, ast.Tuple | ast.List):
            items = tuple(self.value(item, depth + 1) for item in node.elts)
            return UNKNOWN if any(item is UNKNOWN for item in items) else items
        if isinstance(node, ast.UnaryOp):
            return self._unary(node, depth)
        if isinstance(node, ast.BinOp):
            return self._binary(node, depth)
        if isinstance(node, ast.Name):
            bound = self.binding(node)
            return UNKNOWN if bound is None else self.value(bound, depth + 1)
        if isinstance(node, ast.Attribute):
            full = self.dotted(node) or ""
            module, _, name = full.rpartition(".")
            return _NAMED.get(name, UNKNOWN) if module in ("math", "numpy") else UNKNOWN
        if isinstance(node, ast.Call):
            return self._call(node, depth)
        if isinstance(node, ast.Subscript):
            whole, index = self.value(node.value, depth + 1), self.value(node.slice, depth + 1)
            if isinstance(whole, tuple) and isinstance(index, int) and -len(whole) <= index < len(whole):
                return whole[index]
        return UNKNOWN

    def _unary(self, node: ast.UnaryOp, depth: int) -> Any:
        value = self.value(node.operand, depth + 1)
        if isinstance(value, int | float) and isinstance(node.op, ast.USub | ast.UAdd):
            return -value if isinstance(node.op, ast.USub) else value
        return UNKNOWN

    def _binary(self, node: ast.BinOp, depth: int) -> Any:
        left, right = self.value(node.left, depth + 1), self.value(node.right, depth + 1)
        function = _BINARY.get(type(node.op))
        if function is None or not (_small(left) and _small(right)):
            return UNKNOWN
        if isinstance(node.op, ast.Pow) and abs(right) > 64:
            return UNKNOWN
        try:
            return function(left, right)
        except (ArithmeticError, ValueError, TypeError):
            return UNKNOWN

    def _call(self, node: ast.Call, depth: int) -> Any:
        full = self.dotted(node.func) or (node.func.id if isinstance(node.func, ast.Name) else "")
        module, _, name = full.rpartition(".")
        if module not in ("", "math", "numpy") or any(isinstance(a, ast.Starred) for a in node.args):
            return UNKNOWN
        arguments = [self.value(argument, depth + 1) for argument in node.args]
        if any(argument is UNKNOWN for argument in arguments) or not arguments:
            return UNKNOWN
        if name in _WRAPPERS and isinstance(arguments[0], tuple):
            return arguments[0]
        if name not in _CALLS or node.keywords or not all(_small(argument) for argument in arguments):
            return UNKNOWN
        try:
            return _CALLS[name](*arguments)
        except (ArithmeticError, ValueError, TypeError):
            return UNKNOWN


def _small(value: Any) -> bool:
    """Whether a number is so small that arithmetic cannot blow it up into gigabytes."""
    return isinstance(value, int | float) and not isinstance(value, bool) and abs(value) < 1e18
