"""Evaluate sums for planning: named expressions of numbers, in order.

A row is parsed as Python, and only what is on a list is evaluated: numbers, names, + - * / // % **, comparisons,
and calls of `math` and of the closed forms. There are no attributes, no texts, no lists, and all numbers are floats, so that
no row can reach anything or grow without end.
"""

import ast
import inspect
import math
import operator
import re
from collections.abc import Callable, Sequence
from difflib import get_close_matches
from itertools import pairwise
from typing import Any

from ..model import syntax
from ..model.errors import PlanError
from ..model.plan.committed import Plan
from ..model.recording.closed_forms import FORMS, GRAVITY, signature
from .placement_results import Reckoned, Value

MOST, LONGEST = 100, 500
_ROW = re.compile(r"\s*([A-Za-z_]\w*)\s*=(?!=)\s*(.+)", re.DOTALL)
_OPERATORS: dict[type, Callable[..., Any]] = {
    ast.Add: operator.add,
    ast.Sub: operator.sub,
    ast.Mult: operator.mul,
    ast.Div: operator.truediv,
    ast.FloorDiv: operator.floordiv,
    ast.Mod: operator.mod,
    ast.Pow: math.pow,
    ast.USub: operator.neg,
    ast.UAdd: operator.pos,
    ast.Lt: operator.lt,
    ast.LtE: operator.le,
    ast.Gt: operator.gt,
    ast.GtE: operator.ge,
    ast.Eq: operator.eq,
    ast.NotEq: operator.ne,
}
_MATH = "sqrt cbrt exp log log10 log2 sin cos tan asin acos atan atan2 sinh cosh tanh degrees radians hypot floor ceil pow fabs"
_FUNCTIONS: dict[str, Callable[..., Any]] = {
    **{name: getattr(math, name) for name in _MATH.split()},
    "min": min,
    "max": max,
    "abs": abs,
    "round": round,
    **FORMS,
}
_CONSTANTS = {"pi": math.pi, "e": math.e, "tau": math.tau}


def reckon(expressions: Sequence[str], plan: Plan | None = None, place: str = "") -> Reckoned:
    """Evaluate `name = expression` rows; later ones may use earlier names.

    Args:
        expressions: the rows; a row without a name is called `_1`, `_2` …
        plan: its gravity is `g`, and its scalar `constants` are known by their names.
        place: the plan's file, for errors.

    Raises:
        PlanError: a row cannot be read or evaluated; it names the row and the reason.
    """
    if len(expressions) > MOST:
        raise PlanError(f"{len(expressions)} expressions are too many", next_move=f"send at most {MOST} at a time")
    names = {**_CONSTANTS, "g": GRAVITY, **_plan_names(plan)}
    values = []
    for number, row in enumerate(expressions, 1):
        match = _ROW.fullmatch(row)
        name, text = (match[1], match[2].strip()) if match else (f"_{number}", row.strip())
        try:
            if len(text) > LONGEST:
                raise _RefusalError(f"it is {len(text)} characters long", f"write at most {LONGEST}, in several rows")
            if name in _FUNCTIONS:
                raise _RefusalError(f"`{name}` is a function", "give the value another name")
            value = float(_value(_parsed(text), names))
            if not math.isfinite(value):
                raise _RefusalError(f"it comes to {value}", "look for a division by nearly 0 or a power too large")
        except _RefusalError as refusal:
            raise _error(number, row, str(refusal), refusal.next_move, place) from None
        except (ArithmeticError, ValueError, TypeError, RecursionError) as cause:
            move = "look at the numbers it is made of"
            raise _error(number, row, str(cause) or type(cause).__name__, move, place) from None
        names[name] = value
        values.append(Value(name=name, expression=text, value=float(f"{value:.6g}")))
    forms = () if values else tuple(f"{signature(name)}: {_first_sentence(form)}" for name, form in FORMS.items())
    return Reckoned(values=tuple(values), g=names["g"], forms=forms)


class _RefusalError(Exception):
    def __init__(self, cause: str, next_move: str) -> None:
        super().__init__(cause)
        self.next_move = next_move


def _error(number: int, row: str, cause: str, next_move: str, place: str) -> PlanError:
    shown = row if len(row) < 90 else row[:87] + "…"
    return PlanError(f"expression {number}, `{shown}`: {cause}", place=place, next_move=next_move)


def _plan_names(plan: Plan | None) -> dict[str, float]:
    if plan is None:
        return {}
    parameters = plan.simulation_parameters
    constants = {n: float(c.value) for n, c in parameters.constants.items() if not isinstance(c.value, tuple)}
    return {"g": math.hypot(*parameters.gravity_vector), **constants}


def _parsed(text: str) -> ast.expr:
    try:
        return syntax.expression(text)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as cause:
        said = getattr(cause, "msg", None) or cause
        raise _RefusalError(f"it cannot be read: {said}", "write e.g. `v = sqrt(2*g*h)`; powers are `**`") from None


def _value(node: ast.expr, names: dict[str, float]) -> float:
    """The number that a node stands for; a node of a kind that is not on the list is refused."""
    if isinstance(node, ast.Constant) and isinstance(node.value, int | float) and not isinstance(node.value, bool):
        return float(node.value)
    if isinstance(node, ast.Name):
        if node.id not in names:
            raise _unknown("name", node.id, [*names])
        return names[node.id]
    if isinstance(node, ast.UnaryOp | ast.BinOp) and type(node.op) in _OPERATORS:
        sides = [node.operand] if isinstance(node, ast.UnaryOp) else [node.left, node.right]
        return float(_OPERATORS[type(node.op)](*(_value(side, names) for side in sides)))
    if isinstance(node, ast.Compare) and all(type(op) in _OPERATORS for op in node.ops):
        compared = [_value(side, names) for side in (node.left, *node.comparators)]
        held = (_OPERATORS[type(op)](a, b) for op, (a, b) in zip(node.ops, pairwise(compared), strict=True))
        return float(all(held))
    if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
        return _called(node, node.func.id, names)
    raise _RefusalError(
        f"`{ast.unparse(node)[:60]}` is not arithmetic", "use numbers, names, + - * / ** and functions only"
    )


def _called(node: ast.Call, name: str, names: dict[str, float]) -> float:
    function = _FUNCTIONS.get(name)
    if function is None:
        raise _unknown("function", name, [*_FUNCTIONS])
    if any(isinstance(arg, ast.Starred) for arg in node.args) or any(word.arg is None for word in node.keywords):
        raise _RefusalError("`*` and `**` hand nothing over here", "write every argument out")
    given = [_value(arg, names) for arg in node.args]
    named = {str(word.arg): _value(word.value, names) for word in node.keywords}
    if name in FORMS:
        parameters = inspect.signature(function).parameters
        try:
            bound = inspect.signature(function).bind(*given, **named)
        except TypeError as cause:
            raise _RefusalError(str(cause), f"it is called {signature(name)}") from None
        if "g" in parameters:
            bound.arguments.setdefault("g", names["g"])
        return float(function(*bound.args, **bound.kwargs))
    return float(function(*given, **named))


def _unknown(kind: str, name: str, known: list[str]) -> _RefusalError:
    near = get_close_matches(name, known, n=3, cutoff=0.6)
    others = ", ".join(known if kind == "function" else [n for n in known if n not in _CONSTANTS])
    meant = f"did you mean {', '.join(near)}? " if near else ""
    return _RefusalError(f"there is no {kind} `{name}`", f"{meant}known: {others}")


def _first_sentence(form: Callable[..., float]) -> str:
    return (form.__doc__ or "").split("\n")[0].split(" Source:")[0]
