"""Watch half extents: what a program does with the sizes of shapes tells what it takes them for."""

from typing import Any

import numpy as np
from owners import ModelState, raw
from said import SAID
from tracked import Note, note_of

BOX, CAPSULE, CYLINDER, ELLIPSOID = 6, 3, 5, 4
PRODUCTS: dict[int, list[bool]] = {}
"""For each line that multiplies half extents of one box: whether a factor made up for it."""


def of(note: Note, at: Any) -> Any:
    """((model, geom, axis),) for one half extent, or None."""
    if note.field not in ("geom_size", "site_size") or not isinstance(note.owner, ModelState):
        return None
    thing, axis = divmod(int(np.ravel(at)[0]), 3)
    kind = int(raw(note.owner.of, note.field.replace("size", "type"))[thing])
    if kind == BOX or (kind in (CAPSULE, CYLINDER) and axis == 1):
        return frozenset([(id(note.owner), note.field, thing, axis)])
    return None


def _half(value: Any) -> Any:
    note = note_of(value)
    if note is None:
        return None
    if note.half is not None:
        return note.half
    if (
        isinstance(value, np.ndarray)
        and value.ndim == 1
        and note.at is not None
        and note.field in ("geom_size", "site_size")
    ):
        found = [of(note, a) for a in np.ravel(note.at)]
        return frozenset().union(*found) if all(found) else None
    return None


def _number(value: Any) -> float | None:
    return float(value) if np.ndim(value) == 0 and note_of(value) is None else None


def reckoned(name: str, inputs: tuple[Any, ...], result: Note) -> None:
    """Look at arithmetic with half extents."""
    halves = [_half(i) for i in inputs]
    if not any(halves):
        return
    if name in ("absolute", "minimum", "maximum", "clip"):
        return
    if name not in ("multiply", "true_divide", "divide") or len(inputs) != 2:
        return
    mine = next(h for h in halves if h)
    number = next((n for n in map(_number, inputs) if n is not None), None)
    note = next(note_of(i) for i, h in zip(inputs, halves, strict=True) if h)
    if all(halves):
        one, other = halves
        if name == "multiply" and not one & other and {h[:3] for h in one} == {h[:3] for h in other}:
            result.half, result.made = one | other, [*(_made(inputs[0])), *(_made(inputs[1])), _product(SAID.line())]
        return
    if number is None:
        result.half, result.made = (mine, _made_of(note)) if len(mine) > 1 and name == "multiply" else (None, None)
        return
    scale = number if name == "multiply" else 1 / number if number and halves[0] else 0.0
    many = len(mine) > 1 and bool(_made_of(note))
    if not many and abs(scale - 0.5) < 1e-12:
        line = _text()
        if (
            "half" not in line and "size" not in line.partition("=")[0]
        ):  # here a size is made smaller before it is written
            SAID.event("half_of_half")
    elif not _makes_whole(abs(scale)):
        result.half, result.made = mine, _made_of(note)
    elif many:
        for cell in _made_of(note):
            cell[0] = True


def _makes_whole(scale: float) -> bool:
    """Whether a factor is 2, 4 or 8, also with a pi."""
    return any(scale > 0 and abs(scale / whole - 1) < 1e-9 for whole in (2, 4, 8, 16, np.pi, 2 * np.pi, 4 * np.pi / 3))


def _text() -> str:
    import made_worlds

    return made_worlds.text_of(SAID.line()).lower()


def product(value: Any, result: Note) -> None:
    """Look at a product of all half extents, which is an eighth of the volume."""
    half = _half(value)
    if half is not None and len(half) == 3:
        result.half, result.made, result.kind = half, [_product(SAID.line())], "half product"


def _product(line: int) -> list[bool]:
    return PRODUCTS.setdefault(line, [False])


def _made_of(note: Any) -> list[Any]:
    return list(note.made or ())


def _made(value: Any) -> list[Any]:
    return _made_of(note_of(value))


def at_end() -> None:
    """Report products that no factor made up for."""
    for line, (whole,) in PRODUCTS.items():
        if not whole:
            SAID.event("half_product", line)
