"""Compare what an index counts with the array it is used on."""

from typing import Any

import meaning
import numpy as np
from frames import layout_of
from said import SAID
from tracked import Index, Note, Tracked, plain


def kind_of_index(key: Any) -> tuple[str | None, Any]:
    """The kind of thing that an index counts, and its values."""
    if isinstance(key, Index) and key.note is not None:
        return key.note.kind, int(key)
    if isinstance(key, Tracked) and key.dtype.kind in "iu" and key.note is not None:
        note = key.note
        return note.kind or meaning.HOLDS.get(note.field or ""), plain(key)
    if isinstance(key, slice):
        return kind_of_index(key.start)
    if isinstance(key, list) and key and all(isinstance(k, Index) for k in key):
        kinds = {k.note.kind for k in key if k.note is not None}
        return (kinds.pop() if len(kinds) == 1 else None), np.array(list(map(int, key)))
    return None, None


def index(array: Tracked, key: Any, writing: bool) -> None:
    """Report an index of one kind into an array ordered by another."""
    note = array.note
    if note is None or note.field is None or note.at is None:
        return
    if array.ndim != note.owner.rank(note.field) or note.at.size != note.owner.size(note.field):
        return
    first = key[0] if isinstance(key, tuple) and key else key
    kind, value = kind_of_index(first)
    order = meaning.ORDER.get(note.field)
    if kind is None or order is None or kind.startswith("count"):
        return
    if isinstance(value, int) and value == -1 and isinstance(first, Index) and first.note.kind == order:
        SAID.event("missing_name", name=note.field, kind=kind, looked_up=first.note.line)
        return
    if kind == order:
        return
    layout = layout_of(note.owner)
    same = layout.same(kind, order) if layout is not None else None
    if same:
        return
    SAID.event("wrong_index", name=note.field, order=order, kind=kind)


def compare(one: Note | None, other: Note | None) -> None:
    """Report a comparison of two numbers that count different things."""
    if one is None or other is None or not one.kind or not other.kind or one.kind == other.kind:
        return
    kinds = {one.kind, other.kind}
    if ("object type" in kinds or "picture type" in kinds) and kinds != {"object type", "picture type"}:
        SAID.event("compared_kinds", one=one.kind, other=other.kind)
