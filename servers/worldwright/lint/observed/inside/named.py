"""Watch named access: `data.body("x").xpos` and the like are recognised by their address in memory."""

import bisect
import re
import sys
from typing import Any

import jacobian_points
import meaning
import numpy as np
import writes
from fields import _read, tired, tracked
from owners import RAW, DataState
from said import SAID
from tracked import Index, plain, safe

KIND_OF_VIEW = {"Body": "body", "Joint": "joint", "Geom": "geom", "Site": "site", "Camera": "camera", "Light": "light",
    "Sensor": "sensor", "Tendon": "tendon", "Actuator": "actuator", "Equality": "equality", "Keyframe": "keyframe",
    "Mesh": "mesh", "Material": "material", "Texture": "texture", "Hfield": "hfield", "Pair": "pair"}  # fmt: skip


_STARTS: list[int] = []
_SPANS: dict[int, tuple[int, str, Any]] = {}
_KNOWN: set[int] = set()


def spans(state: Any) -> None:
    """Remember where the fields of an owner lie in memory."""
    if id(state) in _KNOWN:
        return
    _KNOWN.add(id(state))
    cls = type(state.of)
    for name in meaning.DATA if isinstance(state, DataState) else meaning.MODEL:
        if (cls, name) not in RAW or name.startswith(("efc_", "iefc_", "contact", "plugin")):
            continue
        array = RAW[(cls, name)].fget(state.of)
        if isinstance(array, np.ndarray) and array.size:
            start = array.__array_interface__["data"][0]
            if start not in _SPANS:
                bisect.insort(_STARTS, start)
            _SPANS[start] = (start + array.nbytes, name, state)
            state.indices(name, array.shape)


def at_address(array: Any) -> tuple[Any, str, Any] | None:
    """(owner, field, flat indices) of an array that lies in one of the owners' fields."""
    start = array.__array_interface__["data"][0]
    place = bisect.bisect_right(_STARTS, start) - 1
    if place < 0:
        return None
    end, name, state = _SPANS[_STARTS[place]]
    if start >= end:
        return None
    first = (start - _STARTS[place]) // max(array.itemsize, 1)
    return state, name, np.arange(first, first + array.size).reshape(array.shape)


def watch_views(cls: type) -> None:
    """Watch every field of one kind of named access."""
    kind = next((k for w, k in KIND_OF_VIEW.items() if w in cls.__name__), None)
    for name, prop in list(vars(cls).items()):
        if type(prop) is not property:
            continue
        RAW[(cls, name)] = prop

        def get(self: Any, _prop: Any = prop, _name: str = name) -> Any:
            found = _prop.fget(self)
            if sys._getframe(1).f_code.co_filename != SAID.program:
                return found
            if _name == "id" and kind is not None:
                return Index.of(found, kind)
            if isinstance(found, np.ndarray) and found.size:
                place = safe(at_address, found)
                if place is not None:
                    state, field, at = place
                    line = sys._getframe(1).f_lineno
                    if tired(line, state.of, field):
                        return found
                    _read(state, field, line, at.ravel())
                    array = tracked(state, field, found, line)
                    array.note.at = at
                    jacobian_points.taken(state, field, at)
                    return array
            return found

        def put(self: Any, value: Any, _prop: Any = prop) -> None:
            found = _prop.fget(self)
            if isinstance(found, np.ndarray) and found.size and sys._getframe(1).f_code.co_filename == SAID.program:
                place = safe(at_address, found)
                if place is not None:
                    array = tracked(place[0], place[1], found, SAID.line())
                    array.note.at = place[2]
                    safe(writes.write, array, Ellipsis, value, None)
            _prop.fset(self, plain(value))

        setattr(cls, name, property(get, put if prop.fset is not None else None))


def watch_access(cls: type, states: Any) -> None:
    """Watch `data.body(...)` and the like: the fields of their owner are remembered by address."""
    for name, method in list(vars(cls).items()):
        if name.startswith("_") or not re.fullmatch(r"[a-z_]+", name) or isinstance(method, property | staticmethod):
            continue
        if not callable(method) or name.startswith(("from_", "bind")):
            continue

        def call(self: Any, *given: Any, _method: Any = method, _name: str = name, **named: Any) -> Any:
            state = safe(states, self)
            if state is not None:
                safe(spans, state)
                if _name in ("key", "keyframe"):
                    state.key_used = True
            return _method(self, *map(plain, given), **{k: plain(v) for k, v in named.items()})

        setattr(cls, name, call)
