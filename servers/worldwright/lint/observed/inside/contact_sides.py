"""Watch the sign of contact forces: a contact's force acts on its second geom, the opposite on the first."""

from typing import Any

import numpy as np
from owners import raw
from said import SAID
from tracked import Note, note_of


def turned(turn: Any, vector: Any, owner: Any, result: Note) -> None:
    """Look at a contact's force that is turned into the world frame."""
    note = note_of(vector)
    if turn is None or note is None or turn[1] != "world" or not isinstance(turn[0], tuple) or turn[0][0] != "contact":
        return
    contacts = raw(owner.of, "contact") if owner is not None and hasattr(owner, "epoch") else ()
    if turn[0][1] < len(contacts):
        contact = contacts[turn[0][1]]
        sign = -1 if note.flipped or (note.store is not None and note.store.get("flipped")) else 1
        result.sides = frozenset([(int(contact.geom1), int(contact.geom2), sign, SAID.line())])


def flipped(sides: Any) -> Any:
    """The same contact forces with the opposite sign."""
    return frozenset((a, b, -sign, line) for a, b, sign, line in sides) if sides else sides


def sides_of(value: Any) -> Any:
    """The contact forces that a value holds."""
    note = note_of(value)
    if note is None:
        return frozenset()
    own = note.store.get("sides", frozenset()) if note.store is not None else frozenset()
    return (note.sides or frozenset()) | own


def reckoned(name: str, inputs: tuple[Any, ...], result: Note) -> None:
    """Look at arithmetic with contact forces."""
    sides = [sides_of(i) for i in inputs]
    negative = name == "negative"
    if name in ("multiply", "true_divide", "divide") and len(inputs) == 2:
        number = next((i for i in inputs if np.ndim(i) == 0), None)
        negative = number is not None and float(number) < 0
    if negative:
        note = next(
            (n for n in map(note_of, inputs) if n is not None and (n.frame is not None or n.store is not None)), None
        )
        result.flipped = not (note is not None and note.flipped)
    elif name in ("multiply", "true_divide", "divide"):
        result.flipped = any(n.flipped for n in map(note_of, inputs) if n is not None)
    if not any(sides):
        return
    if name in ("add", "subtract"):
        other = flipped(sides[1]) if name == "subtract" else sides[1]
        result.sides = sides[0] | other
        _report_one_sign(sides[0], other)
    elif name in ("multiply", "true_divide", "divide", "negative"):
        mine = frozenset().union(*sides)
        result.sides = flipped(mine) if negative else mine


def kept(store: dict[str, Any], operation: str, value: Any) -> None:
    """Look at a contact force that is stored in an array of the program's own."""
    sides = sides_of(value)
    if operation in ("add", "subtract") and sides:
        other = flipped(sides) if operation == "subtract" else sides
        _report_one_sign(store.get("sides", frozenset()), other)
        store["sides"] = store.get("sides", frozenset()) | other
    elif operation == "multiply" and np.ndim(value) == 0 and float(value) < 0:
        store["flipped"] = not store.get("flipped", False)
        store["sides"] = flipped(store.get("sides"))
    elif not operation:
        store["sides"] = sides


def _report_one_sign(one: Any, other: Any) -> None:
    """Report a geom that is first in one contact and second in another, where both are added with the same sign."""
    for a, b, sign, _ in one:
        for c, d, same, line in other:
            if sign == same and (a, b) != (c, d) and (a == d or b == c):
                SAID.event("sign_forgotten", line)
                return
