"""Tell the order of quaternions by the names of their parts, and follow where they end up."""

import ast
import re
from typing import Any

import numpy as np
from said import SAID
from tracked import Note, Tracked, note_of

ORDERS = ("xyzw", "wxyz")


def order_of(parts: list[ast.expr]) -> str | None:
    """The order in which four names stand, or None."""
    names = []
    for part in parts:
        if isinstance(part, ast.UnaryOp):
            part = part.operand
        name = part.id if isinstance(part, ast.Name) else part.attr if isinstance(part, ast.Attribute) else ""
        names.append(name.lower())
    if len(names) != 4 or not all(names):
        return None
    stems = {re.sub(r"_?[xyzw]$", "", n) for n in names}
    letters = "".join(n[-1] for n in names)
    return letters if len(stems) == 1 and letters in ORDERS else None


class Ordered(list):  # type: ignore[type-arg]
    """Four numbers with a known order."""

    order = ""


def made(order: str, parts: Any) -> Any:
    """A list whose parts' names tell an order."""
    found = Ordered(parts)
    found.order = order
    return found


def unpacked(order: str, value: Any) -> Any:
    """Look at a quaternion whose four parts are given names."""
    import uses

    note = note_of(value)
    if note is not None and isinstance(value, np.ndarray) and value.shape == (4,):
        mine = "wxyz" if uses.is_quaternion(value) else note.kind
        if mine in ORDERS and mine != order:
            SAID.event("quaternion_order", SAID.line(), name="taken apart")
    return value


def noted(value: Ordered, array: Any) -> Any:
    """Note the order of four numbers on an array made of them."""
    if array.shape != (4,) or array.dtype.kind != "f":
        return array
    found = array.view(Tracked)
    found.note = Note(kind=value.order, line=SAID.line())
    return found


def given(value: Any, name: str) -> None:
    """Look at a quaternion that is given to the engine."""
    note = note_of(value)
    order = note.kind if note is not None else getattr(value, "order", None) if isinstance(value, Ordered) else None
    if order == "xyzw" and np.size(value) == 4:
        SAID.event("quaternion_order", SAID.line(), name=name)


def called(name: str, arguments: tuple[Any, ...]) -> None:
    """Look at a call of one of the engine's functions about quaternions."""
    if name.startswith("mju_") and re.search("[qQ]uat", name):
        for value in arguments:
            if not (name in ("mju_mat2Quat", "mju_axisAngle2Quat", "mju_euler2Quat") and value is arguments[0]):
                given(value, name)


def added(note: Note, places: Any, value: Any, line: int) -> None:
    """Report numbers that are added to three parts of a quaternion, as if they were a rotation vector."""
    from frames import layout_of

    layout = layout_of(note.owner)
    if layout is None or note.field not in ("qpos", "qpos0", "key_qpos") or np.size(value) != 3:
        return
    here = [int(p) % max(layout.model.nq, 1) for p in np.ravel(places)]
    if len(here) == 3 and any(set(here) < quat and min(here) > min(quat) for quat in layout.quats):
        SAID.event("quaternion_added", line)


def norm(owner: Any, places: Any, given_value: Any, labels: frozenset[str], line: int) -> None:
    """Report a quaternion that comes from sums and is written without being normalised."""
    flat = [int(p) for p in np.ravel(places)]
    values = np.ravel(np.asarray(given_value, float))
    if "qpos" not in labels or values.size != len(flat):
        return
    by_place = dict(zip(flat, values, strict=True))
    for quat in owner.layout.quats:
        if quat <= set(flat) and abs(float(np.linalg.norm([by_place[p] for p in quat])) - 1.0) > 0.05:
            SAID.event("quaternion_added", line)
