"""Cut answers so that every client passes them on whole: at most 20 KB of text each, the rest by page, no silent loss.

Coding harnesses cut longer results in the middle, save them to a file or reset the call. A tool whose answer holds lists of
things (findings, objects, jobs) therefore takes `page`; whatever else still grows too long is shortened, and the answer says
so in `shortened`.
"""

import inspect
import json
import typing
from typing import Any

from pydantic import BaseModel

from .model.errors import NotFoundError

LIMIT_BYTES = 20_000
ROOM_BYTES = 500
"""So many bytes are kept free for `shortened` itself."""


def size(value: Any) -> int:
    """Bytes of a value as compact JSON."""
    return len(json.dumps(value, ensure_ascii=False, separators=(",", ":")).encode())


def lists(answer: type[BaseModel]) -> tuple[str, ...]:
    """The fields of an answer that hold things, findings first, of which its pages are made."""
    found = [name for name, field in answer.model_fields.items() if _holds_things(field.annotation)]
    return tuple(sorted(found, key=lambda name: name not in ("findings", "anomalies")))


def _holds_things(kind: Any) -> bool:
    items = typing.get_args(kind)
    things = [item for item in items if inspect.isclass(item) and issubclass(item, BaseModel)]
    return typing.get_origin(kind) in (list, tuple) and bool(things)


def fit(data: dict[str, Any], fields: tuple[str, ...] = (), page: int = 1) -> dict[str, Any]:
    """The answer, or a page of it, that fits; it has `shortened` if it is not complete.

    Args:
        data: an answer as JSON data.
        fields: its lists of things, which are turned into pages one after the other.
        page: the number of the page, from 1.

    Raises:
        NotFoundError: there is no such page.
    """
    notes: list[str] = []
    fields = tuple(field for field in fields if isinstance(data.get(field), list))  # some are written only when needed
    if fields:
        items = [(field, item) for field in fields for item in data[field]]
        room = LIMIT_BYTES - ROOM_BYTES - size({**data, **{field: [] for field in fields}})
        pages = _pages([size(item) + 1 for _, item in items], max(room, LIMIT_BYTES // 2))
        if not 1 <= page <= len(pages):
            raise NotFoundError(
                f"there is no page {page}", next_move=f"this answer has {len(pages)}; page=1 is the first"
            )
        if len(pages) > 1:
            start, stop = pages[page - 1]
            data = {**data, **{field: [one for name, one in items[start:stop] if name == field] for field in fields}}
            more = f"the rest with page={page + 1}" if page < len(pages) else "this is the last page"
            notes.append(f"{start + 1} to {stop} of {len(items)} ({', '.join(fields)}); {more}")
    cut: dict[str, str] = {}
    while size(data) > LIMIT_BYTES - ROOM_BYTES:
        path, value = _longest(data, ())
        kept = value[: max(len(value) // 2, 1)]
        if len(kept) == len(value):
            break
        data = _replaced(data, path, kept)
        name = ".".join(str(part) for part in path if isinstance(part, str))
        cut[name] = f"{name} cut to its first {len(kept)}"
    notes += list(cut.values())[:4]
    return {**data, "shortened": "; ".join(notes)} if notes else data


def _pages(sizes: list[int], room: int) -> list[tuple[int, int]]:
    """Consecutive ranges of whole items that each fit into the room, or are one item."""
    pages, start, used = [], 0, 0
    for index, one in enumerate(sizes):
        if index > start and used + one > room:
            pages.append((start, index))
            start, used = index, 0
        used += one
    return [*pages, (start, len(sizes))]


def _longest(value: Any, path: tuple[Any, ...]) -> tuple[tuple[Any, ...], Any]:
    """The path to the list or text that takes the most room, except lists that hold a longer one, and its value."""
    parts = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    inner = max((_longest(part, (*path, key)) for key, part in parts), key=lambda found: size(found[1]), default=None)
    own = isinstance(value, str) or (isinstance(value, list) and len(value) > 1)
    if own and (inner is None or size(inner[1]) * 2 < size(value)):
        return path, value
    return inner if inner is not None else (path, value if own else [])


def _replaced(value: Any, path: tuple[Any, ...], new: Any) -> Any:
    if not path:
        return new
    copy = dict(value) if isinstance(value, dict) else list(value)
    copy[path[0]] = _replaced(value[path[0]], path[1:], new)
    return copy
