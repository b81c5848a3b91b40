"""Watch how a program makes its numbers: numpy's makers, counting, clocks and conversions hand notes on."""

import ast
import math
import sys
import time
from typing import Any

import angle_sizes
import index_uses
import numpy as np
import quaternion_names
import same_objects
import uses
from said import SAID
from tracked import Index, Note, Real, Tracked, labels_of, note_of, notes_in, plain, safe


class Arrays:
    """A program's own arrays are told apart by the order they are made in."""

    made = 0


def _own(found: Any) -> Any:
    Arrays.made += 1
    array = found.view(Tracked)
    store = {"frames": [], "labels": frozenset()}
    array.note = Note(field=None, at=np.arange(found.size).reshape(found.shape), store=store, line=SAID.line())
    return array


def _mine() -> bool:
    return sys._getframe(2).f_code.co_filename == SAID.program


def install() -> None:
    """Wrap numpy's makers and the clocks."""
    for name in ("zeros", "empty", "ones", "full"):
        original = getattr(np, name)

        def make(*given: Any, _original: Any = original, **named: Any) -> Any:
            found = _original(*map(plain, given), **{k: plain(v) for k, v in named.items()})
            return _own(found) if _mine() and found.dtype == np.float64 and found.size < 100_000 else found

        setattr(np, name, make)
    array, asarray = np.array, np.asarray

    def made(value: Any = None, *given: Any, _make: Any = array, **named: Any) -> Any:
        if not _mine():
            return _make(value, *given, **named)
        found = _make(plain(value), *given, **named)
        if isinstance(value, quaternion_names.Ordered):
            return quaternion_names.noted(value, found)
        notes = notes_in(value)
        if isinstance(value, Tracked):
            if value.note is not None and isinstance(found, np.ndarray) and found.shape == value.shape:
                same = found.view(Tracked)
                shares = _make is asarray and np.shares_memory(found, plain(value))
                same.note = value.note if shares else value.note.but(live=False)
                return same
            return found
        safe(uses.same_views, value)
        if not notes or found.dtype.kind not in "fiu":
            return found
        kinds = {n.kind for n in notes}
        out = found.view(Tracked)
        kind = kinds.pop() if len(kinds) == 1 and found.dtype.kind in "iu" and len(notes) == found.size else None
        out.note = Note(kind=kind, labels=labels_of(notes), owner=notes[0].owner)
        return out

    np.array = made  # type: ignore[assignment]
    np.asarray = lambda value=None, *g, **n: (  # type: ignore[assignment]
        made(value, *g, _make=asarray, **n) if _mine() else asarray(value, *g, **n)
    )
    for name in ("time", "perf_counter", "monotonic", "process_time"):
        clock = getattr(time, name)

        def tell(_clock: Any = clock) -> Any:
            return Real.of(_clock(), Note(labels=frozenset(("wall clock",)))) if _mine() else _clock()

        setattr(time, name, tell)
    sleep = time.sleep
    time.sleep = lambda seconds: sleep(min(float(seconds), 0.001)) if _mine() else sleep(seconds)  # type: ignore[assignment]
    for name in ("radians", "sin", "cos", "tan", "degrees"):
        function = getattr(math, name)

        def convert(value: Any, _function: Any = function, _name: str = name) -> Any:
            note = note_of(value)
            if note is None:
                return _function(value)
            found = safe(
                uses.ufunc,
                getattr(np, {"radians": "deg2rad", "degrees": "rad2deg"}.get(_name, _name)),
                "__call__",
                (value,),
            )
            return Real.of(_function(float(value)), found)

        setattr(math, name, convert)


class Counted(list):  # type: ignore[type-arg]
    """A range whose numbers remember what they count."""


def counting(*given: Any) -> Any:
    """As `range`."""
    stop = given[0] if len(given) == 1 else given[1] if len(given) > 1 else None
    kind = note_of(stop).kind if isinstance(stop, Index) and note_of(stop) is not None else None  # type: ignore[union-attr]
    plain_range = range(*[int(g) for g in given])
    if kind is None or len(plain_range) > 20_000:
        return plain_range
    word = kind.removeprefix("count ")
    return Counted(Index.of(i, word) for i in plain_range) if kind.startswith("count ") else plain_range


def numbered(things: Any, start: int = 0) -> Any:
    """As `enumerate`."""
    from contact_records import ContactList

    if isinstance(things, ContactList) and start == 0:
        return ((Index.of(i, "contact"), c) for i, c in enumerate(things))
    return enumerate(things, start)


def whole(*given: Any) -> Any:
    """As `int`."""
    found = int(*[plain(g) if not isinstance(g, str) else g for g in given])
    value = given[0] if given else None
    if isinstance(value, Index) and value.note is not None and value.note.kind:
        return Index.of(found, value.note.kind, value.note)
    if type(value).__name__ == "mjtObj":
        return Index.of(found, "object type")
    if isinstance(value, Tracked) and value.note is not None and value.size == 1:
        kind, _ = index_uses.kind_of_index(value)
        return Index.of(found, kind) if kind else found
    return found


def fraction(*given: Any) -> Any:
    """As `float`."""
    found = float(*[plain(g) if not isinstance(g, str) else g for g in given])
    note = note_of(given[0]) if given else None
    return Real.of(found, note) if note is not None and isinstance(given[0], Real) else found


def length(thing: Any) -> Any:
    """As `len`."""
    from contact_records import ContactList

    return Index.of(len(thing), "count contact") if isinstance(thing, ContactList) else len(thing)


def ordered(things: Any) -> Any:
    """The things of a loop, in their order; a set of words has another one in every run."""
    if type(things) in (set, frozenset) and len(things) > 1 and any(isinstance(t, str) for t in things):
        SAID.event("set_order")
    return things


def _called(name: str, place: ast.expr, *given: ast.expr) -> ast.expr:
    return ast.copy_location(ast.Call(ast.Name(name, ast.Load()), list(given), []), place)


class _Calls(ast.NodeTransformer):
    names = {
        "range": "_ww_range",
        "enumerate": "_ww_enumerate",
        "int": "_ww_int",
        "float": "_ww_float",
        "len": "_ww_len",
    }

    def visit_List(self, node: ast.List) -> Any:
        """Mark four numbers whose names tell an order."""
        self.generic_visit(node)
        order = quaternion_names.order_of(node.elts) if isinstance(node.ctx, ast.Load) else None
        return _called("_ww_order", node, ast.Constant(order), node) if order else node

    def visit_Assign(self, node: ast.Assign) -> Any:
        """Mark four names that are given to the parts of a quaternion."""
        self.generic_visit(node)
        target = node.targets[0]
        order = quaternion_names.order_of(target.elts) if isinstance(target, ast.Tuple) else None
        if order and not isinstance(node.value, ast.Tuple):
            node.value = _called("_ww_unpack", node.value, ast.Constant(order), node.value)
        return node

    def visit_BinOp(self, node: ast.BinOp) -> Any:
        """Mark a list that is repeated."""
        self.generic_visit(node)
        return (
            _called("_ww_list", node, node)
            if isinstance(node.op, ast.Mult) and isinstance(node.left, ast.List)
            else node
        )

    def visit_ListComp(self, node: ast.ListComp) -> Any:
        """Mark a list that a loop makes."""
        self.generic_visit(node)
        return _called("_ww_list", node, node)

    def visit_For(self, node: ast.For) -> Any:
        """Mark a loop whose order shows in what it makes."""
        self.generic_visit(node)
        made = [n for b in node.body for n in ast.walk(b)]
        builds = any(isinstance(n, ast.Attribute) and n.attr.startswith(("add_", "append", "extend")) for n in made)
        builds |= any(isinstance(n, ast.Name) and n.id == "_ww_append" for n in made)
        builds |= any(isinstance(n, ast.AugAssign) and isinstance(n.op, ast.Add) for n in made)
        if builds and not isinstance(node.iter, ast.Constant):
            node.iter = ast.copy_location(ast.Call(ast.Name("_ww_iter", ast.Load()), [node.iter], []), node.iter)
        return node

    def visit_Call(self, node: ast.Call) -> Any:
        self.generic_visit(node)
        if isinstance(node.func, ast.Name) and node.func.id in self.names:
            node.func = ast.copy_location(ast.Name(self.names[node.func.id], ast.Load()), node.func)
        if isinstance(node.func, ast.Attribute) and not node.keywords and len(node.args) == 1:
            if node.func.attr == "append":
                return _called("_ww_append", node, node.func.value, node.args[0])
            base = node.func.value
            if (
                node.func.attr in ("sin", "cos", "tan")
                and isinstance(base, ast.Name)
                and base.id in ("np", "numpy", "math")
            ):
                node.args = [_called("_ww_angle", node.args[0], node.args[0])]
        return node


WORDS = {
    "_ww_range": counting,
    "_ww_enumerate": numbered,
    "_ww_int": whole,
    "_ww_float": fraction,
    "_ww_len": length,
    "_ww_iter": ordered,
    "_ww_order": quaternion_names.made,
    "_ww_unpack": quaternion_names.unpacked,
    "_ww_append": same_objects.appended,
    "_ww_angle": angle_sizes.taken,
    "_ww_list": same_objects.listed,
}


def rewritten(text: str, path: str) -> Any:
    """A program's code in which counting and conversion hand notes on; places stay what they were."""
    tree = ast.parse(text, path)
    assigned = {n.id for n in ast.walk(tree) if isinstance(n, ast.Name) and isinstance(n.ctx, ast.Store)}
    calls = _Calls()
    calls.names = {k: v for k, v in calls.names.items() if k not in assigned}
    return compile(ast.fix_missing_locations(calls.visit(tree)), path, "exec")
