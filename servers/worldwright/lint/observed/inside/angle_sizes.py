"""Find angles so large and so round that they must be degrees."""

from typing import Any

import numpy as np
from meaning import Layout
from owners import DataState, raw
from said import SAID
from tracked import note_of, plain

FULL = 2 * np.pi


def _round(value: float) -> bool:
    """Whether people write degrees like this number: a multiple of five that would be beyond a full turn in radians."""
    return abs(value) >= 10.0 and abs(value / 5 - round(value / 5)) < 1e-9


def wrote(owner: DataState, field: str, places: Any, value: Any, labels: frozenset[str], line: int) -> None:
    """Look at a write to the coordinate of a hinge, or to the target of its servo."""
    note = note_of(value)
    if (note is not None and note.field is not None) or labels:
        return
    flat, given = np.ravel(places), np.ravel(np.asarray(plain(value), float))
    if given.size == 1:
        given = np.repeat(given, flat.size)
    if given.size != flat.size:
        return
    large = [(int(p), float(v)) for p, v in zip(flat, given, strict=True) if abs(v) > FULL]
    if not large:
        return
    hinges = owner.layout.hinges if field == "qpos" else _servos(owner)
    for place, number in large:
        if place in hinges and _beyond(owner, field, place, number):
            SAID.event("degrees_for_radians", line, name=field, value=number)
            return


def _servos(owner: DataState) -> set[int]:
    """The controls that command the angle of a hinge."""
    model = owner.model.of
    layout: Layout = owner.layout
    if ("ctrl", "joint") not in layout.maps:
        return set()
    joints, kinds = layout.maps[("ctrl", "joint")], raw(model, "jnt_type")
    gain, bias = np.asarray(raw(model, "actuator_gainprm")), np.asarray(raw(model, "actuator_biasprm"))
    servo = (gain[:, 0] > 0) & (np.abs(bias[:, 1] + gain[:, 0]) < 1e-9)
    return {i for i in np.flatnonzero(servo).tolist() if int(kinds[joints[i]]) == 3}


def _beyond(owner: DataState, field: str, place: int, value: float) -> bool:
    model = owner.model.of
    if field == "qpos":
        joint = int(np.flatnonzero(raw(model, "jnt_qposadr") == place)[0])
    else:
        joint = int(owner.layout.maps[("ctrl", "joint")][place])
    low, high = raw(model, "jnt_range")[joint]
    if raw(model, "jnt_limited")[joint]:
        return bool(abs(value) > FULL and not low - 0.5 <= value <= high + 0.5)
    return _round(value)


ANGLES: dict[int, list[float]] = {}
"""For each line: the plain numbers of which a sine or cosine was taken."""
RIGHT = {30.0, 45.0, 60.0, 90.0, 120.0, 135.0, 150.0, 180.0, 270.0, 360.0}


def taken(value: Any) -> Any:
    """Remember a number of which a sine or cosine is taken."""
    if note_of(value) is None and np.ndim(value) <= 1 and np.size(value) < 100:
        seen = ANGLES.setdefault(SAID.line(), [])
        if len(seen) < 200:
            seen.extend(np.ravel(np.asarray(value, float)).tolist())
    return value


def at_end() -> None:
    """Report lines that took sines or cosines of nothing but round numbers of degrees."""
    for line, values in ANGLES.items():
        some = {abs(v) for v in values if v}
        if some and all(v % 5 == 0 for v in some) and max(some) >= 30 and (len(some) > 1 or some <= RIGHT):
            SAID.event("degrees_for_radians", line, name="the sine", value=max(some))


def compared(one: Any, other: Any) -> None:
    """Report an angle in degrees that is compared with one in radians."""
    import meaning

    for a, b in ((note_of(one), note_of(other)), (note_of(other), note_of(one))):
        names = b.labels | ({b.field} if b.field else set()) if b is not None else set()
        mixed = a is not None and b is not None and a.kind == "degrees" and b.kind != "degrees"
        if mixed and names and names <= meaning.RADIANS - {"actuator_ctrlrange"}:
            SAID.event("degrees_meet_radians", name=min(names))


def turned(name: str, everything: list[Any], line: int) -> None:
    """Look at an angle that is given to a function of the engine."""
    if name == "mju_axisAngle2Quat" and len(everything) == 3 and _round(float(everything[2])):
        SAID.event("degrees_for_radians", line, name=name, value=float(everything[2]))
