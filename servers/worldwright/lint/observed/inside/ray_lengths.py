"""Watch whether a ray's answer, a multiple of the direction that was given, is taken for metres."""

from typing import Any

import numpy as np
from owners import DataState, raw
from said import SAID
from tracked import Note, Real, note_of

RAYS: dict[int, dict[str, Any]] = {}
"""For each line with a ray: whether its answers were used as a length, and whether they were scaled."""


def _vectors(everything: list[Any]) -> list[Any]:
    return [g for g in everything if isinstance(g, np.ndarray) and g.dtype.kind == "f"]


def cast(name: str, state: DataState, line: int, given: tuple[Any, ...], everything: list[Any], found: Any) -> Any:
    """Look at a ray that was cast; returns its answer with a note."""
    floats = _vectors(everything)
    if len(floats) < 2:
        return None
    _report_own_body(state, line, given, everything)
    lengths = np.linalg.norm(floats[1].reshape(-1, 3), axis=1)
    if (np.abs(lengths - 1.0) < 1e-3).all() or not lengths.all():
        return None
    ray = RAYS.setdefault(line, {"used": name == "mj_multiRay", "scaled": False, "length": 0.0})
    ray["length"] = float(lengths[np.argmax(np.abs(lengths - 1.0))])
    if name == "mj_multiRay":
        for array in given:
            note = note_of(array)
            if note is not None and note.store is not None and array.dtype.kind == "f" and array.size == len(lengths):
                note.store["ray"] = line
        return None
    return Real.of(found, Note(kind="ray multiple", line=line, labels=frozenset(("mj_ray",))))


def _report_own_body(state: DataState, line: int, given: tuple[Any, ...], everything: list[Any]) -> None:
    """Report a ray that starts at a site and hits the body that carries the site."""
    note = note_of(given[2]) if len(given) > 2 else None
    hit = next((g for g in everything if isinstance(g, np.ndarray) and g.dtype.kind == "i"), None)
    if note is None or note.field != "site_xpos" or note.at is None or hit is None or hit.size != 1 or int(hit[0]) < 0:
        return
    model = state.model.of
    body = int(raw(model, "site_bodyid")[int(np.ravel(note.at)[0]) // 3])
    if body and int(raw(model, "geom_bodyid")[int(hit[0])]) == body:
        SAID.event("ray_hits_itself", line)


def _ray_of(note: Any) -> dict[str, Any] | None:
    if note is None:
        return None
    if note.kind == "ray multiple":
        return RAYS.get(note.line)
    return RAYS.get(note.store.get("ray", 0)) if note.store is not None else None


def used(value: Any) -> None:
    """Note that an answer is kept or shown."""
    ray = _ray_of(note_of(value))
    if ray is not None:
        ray["used"] = True


def reckoned(name: str, inputs: tuple[Any, ...]) -> None:
    """Look at arithmetic with an answer: to multiply it with a vector or a length is right."""
    for place, value in enumerate(inputs):
        ray = _ray_of(note_of(value))
        if ray is None:
            continue
        others = [o for i, o in enumerate(inputs) if i != place]
        if name in ("multiply", "matmul") and any(isinstance(o, np.ndarray | np.floating) for o in others):
            ray["scaled"] = True
        elif name in ("add", "subtract", "true_divide", "divide", "minimum", "maximum", "multiply"):
            ray["used"] = True


def compared(value: Any, other: Any) -> None:
    """Look at a comparison: with 1, the end of the direction, an answer is used rightly."""
    ray = _ray_of(note_of(value))
    if ray is not None and isinstance(other, int | float) and abs(other - 1.0) <= 0.11:
        ray["scaled"] = True


def at_end() -> None:
    """Report answers that were used and never scaled."""
    for line, ray in RAYS.items():
        if ray["used"] and not ray["scaled"]:
            SAID.event("ray_not_unit", line, length=round(ray["length"], 4))
