"""Watch how a program uses the engine's numbers: a wrong index, a wrong frame, a wrong unit, a view for a copy."""

import re
from typing import Any

import angle_sizes
import contact_sides
import half_sizes
import inputs_held
import jacobian_points
import meaning
import numpy as np
import ray_lengths
import sixes
import state_columns
from frames import differ, frame_of, is_turned, layout_of, say, tell, turn_of
from index_uses import compare, index
from said import SAID
from tracked import Hooks, Index, Note, Real, Tracked, labels_of, note_of, notes_in

INVERSE = {"deg2rad", "radians"}


# -- arithmetic -----------------------------------------------------------------------------------------------------


def is_quaternion(value: Any) -> bool:
    """Whether a value is four numbers that the engine keeps as a quaternion."""
    note = note_of(value)
    if note is None or not isinstance(value, np.ndarray) or value.shape != (4,):
        return False
    if note.kind in ("wxyz", "xyzw"):
        return note.kind == "wxyz"
    if note.at is None or not (np.diff(note.at.ravel()) == 1).all():
        return False
    if note.field in meaning.QUATERNIONS:
        return True
    if note.at is not None and (note.order == "qpos" or note.field in ("qpos", "qpos0", "key_qpos")):
        layout = layout_of(note.owner)
        return layout is not None and frozenset(int(a) for a in note.at.ravel()) in layout.quats
    return False


def taken(note: Note) -> None:
    """Look at a value that is really read, not only kept as a view for later."""
    note.pending = False
    if note.field == "cvel":
        _velocity(note)
    at = note.at.ravel() if note.at is not None else None
    note.owner.read(note.field, SAID.line(), at)
    note.owner.asked(note.field, note.born or SAID.line(), at)


def _velocity(note: Note) -> None:
    """Look at three of the six numbers of `cvel`: which three they are, and of which point."""
    import made_worlds

    places = np.ravel(note.at)
    if note.owner.dirty or places.size != 3 or places[0] % 3 or not (np.diff(places) == 1).all():
        return
    body, text = int(places[0]) // 6, made_worlds.text_of(note.line)
    if places[0] % 6 == 0:
        if re.search(r"lin|speed|\bvel(ocity)?\b|\bv\b", text) and not re.search(
            r"ang|omega|rot|gyro|rate|\bw\b", text
        ):
            SAID.event("rotation_first", note.line, name="cvel")
        return
    exact = note.owner.velocity(body)
    here = note.owner.row("cvel", body)[3:]
    if float(np.abs(exact - here).max()) > 1e-3 * max(1.0, float(np.abs(exact).max())) and not made_worlds.says(
        "subtree_com|cross"
    ):
        SAID.event("velocity_elsewhere", note.line, name="cvel")


LINEAR = {"add", "subtract"}
COMPARED = {"add", "subtract", "less", "less_equal", "greater", "greater_equal", "minimum", "maximum"}
KEEPS = {"multiply", "true_divide", "divide", "negative", "positive", "clip", "minimum", "maximum"}


def ufunc(what: Any, method: str, inputs: tuple[Any, ...]) -> Note | None:
    """The note on a result; what is odd about its making is reported."""
    notes = [n for n in map(note_of, inputs) if n is not None]
    if not notes:
        return None
    name = what.__name__
    result = Note(labels=labels_of(notes), owner=next((n.owner for n in notes if n.owner is not None), None))
    result.epoch = read_at(notes)
    result.since = max((now(n) for n in notes if n.since is not None), key=lambda s: s[1], default=None)
    if method != "__call__":
        for note in notes:
            if note.pending:
                taken(note)
        if name == "multiply":
            half_sizes.product(inputs[0], result)
        return result
    frames = [frame_of(i) for i in inputs]
    owners = [n.owner for n in notes]
    for one, value in zip(map(note_of, inputs), inputs, strict=True):
        if one is not None and one.pending:
            taken(one)
        if one is None or name not in LINEAR | KEEPS:
            continue
        found = one.order or (meaning.ORDER.get(one.field or "") if _is_whole(value) else None)
        result.order = "dof" if found == "qpos" and result.order == "dof" else found or result.order
    ray_lengths.reckoned(name, inputs)
    if name in COMPARED and len(inputs) == 2:
        angle_sizes.compared(*inputs)
    half_sizes.reckoned(name, inputs, result)
    contact_sides.reckoned(name, inputs, result)
    if name in LINEAR and len(inputs) == 2:
        if differ(frames[0], frames[1], owners) and not _components(inputs, frames):
            tell(frames[0], frames[1], "arithmetic", inputs)
        result.frame = next((f for f in frames if f is not None), None)
        _same_memory(inputs)
        if name == "subtract":
            _difference(inputs, result)
    elif name in KEEPS:
        if name == "multiply":
            inputs_held.reckoned(notes)
        found = [f for f in frames if f is not None]
        scale = any(
            isinstance(i, np.ndarray) and np.ndim(i) > 0 and f is None for i, f in zip(inputs, frames, strict=True)
        )
        if len(found) == 1 and not scale:
            result.frame, result.picked = found[0], max(n.picked for n in notes)
        if len(inputs) == 2 and name in ("true_divide", "divide"):
            _rate(inputs, result)
        elif len(inputs) == 2 and name == "multiply":
            result.delta = None
        else:
            result.delta = notes[0].delta
    elif name in ("matmul", "dot"):
        result.frame, result.rot = _turned(inputs)
        contact_sides.turned(turn_of(inputs[0]), inputs[1], result.owner, result)
        _jacobian(inputs)
    elif name in INVERSE:
        _degrees(inputs[0])
        result.labels = frozenset()
    elif name in ("rad2deg", "degrees"):
        result.kind = "degrees" if result.labels and result.labels <= meaning.RADIANS else None
        result.labels = frozenset()
    elif name in ("sin", "cos", "tan"):
        if notes[0].labels == {"cam_fovy"} or notes[0].field == "cam_fovy":
            SAID.event("degrees_as_radians", name="cam_fovy")
    elif name in ("equal", "not_equal"):
        pair = [_kind(i) for i in inputs]
        if len(pair) == 2 and all(pair):
            compare(Note(kind=pair[0]), Note(kind=pair[1]))
        return None
    elif name in ("absolute", "square", "sqrt"):
        result.kind = notes[0].kind if notes[0].kind == "quaternion difference" else None
    if name in LINEAR and notes[0].kind == "segment type":
        result.kind = None
    return result


def read_at(notes: list[Note]) -> int:
    """The latest step at which any of the notes was read."""
    return max((n.owner.epoch if n.live and n.owner is not None else n.epoch for n in notes), default=0)


def now(note: Note) -> Any:
    """(model, version) of a value that is read from a model's array."""
    return (id(note.owner), note.owner.version) if note.live and note.owner is not None else note.since


def _components(inputs: tuple[Any, ...], frames: list[Any]) -> bool:
    """Whether the inputs are single components of contact forces: normal forces are summed whichever way they point."""
    return all(
        np.ndim(i) == 0 and isinstance(f, tuple) and f[0] == "contact" for i, f in zip(inputs, frames, strict=True)
    )


def _kind(value: Any) -> str | None:
    note = note_of(value)
    return note.kind if note is not None else None


def _is_whole(value: Any) -> bool:
    note = note_of(value)
    return (
        note is not None
        and note.field is not None
        and note.at is not None
        and note.owner is not None
        and note.at.size == note.owner.size(note.field)
        and np.ndim(value) == 1
    )


def _same_memory(inputs: tuple[Any, ...]) -> None:
    """Report a value that is set against itself: both are the same memory, though read at different times."""
    one, other = inputs
    if not (isinstance(one, Tracked) and isinstance(other, Tracked)):
        return
    a, b = one.note, other.note
    if a is None or b is None or not (a.live and b.live) or a.owner is not b.owner or a.field != b.field:
        return
    if a.at is None or b.at is None or a.at.shape != b.at.shape or not np.array_equal(a.at, b.at):
        return
    if a.epoch != b.epoch and a.owner.epoch > min(a.epoch, b.epoch):
        SAID.event("same_view", a.line if a.epoch < b.epoch else b.line, name=a.field)


def _difference(inputs: tuple[Any, ...], result: Note) -> None:
    one, other = note_of(inputs[0]), note_of(inputs[1])
    quats = [is_quaternion(i) for i in inputs]
    if any(quats) and all(isinstance(i, np.ndarray) and i.shape == (4,) for i in inputs):
        result.kind = "quaternion difference"
    if one is None or other is None or one.time is None or other.time is None or one.owner is not other.owner:
        return
    if one.field is not None and one.field == other.field:
        span = float(one.time) - float(other.time)
        if span > 0:
            result.delta = span


def _rate(inputs: tuple[Any, ...], result: Note) -> None:
    """Report a difference over some steps that is divided by the time of another number of steps."""
    above, below = note_of(inputs[0]), note_of(inputs[1])
    if above is None or above.delta is None or np.ndim(inputs[1]) != 0:
        result.delta = None
        return
    span = float(inputs[1])
    if below is not None and "timestep" in below.labels and abs(span - above.delta) > 0.05 * above.delta and span > 0:
        SAID.event("wrong_interval", spanned=round(above.delta, 9), divided=round(span, 9))


def _turned(inputs: tuple[Any, ...]) -> tuple[Any, Any]:
    """The frame of a turned vector, or the turn that two turns make."""
    left, right = inputs
    one, two = turn_of(left), turn_of(right)
    if one is not None and two is not None:
        return None, ((two[0], one[1]) if two[1] == one[0] else None)
    if one is not None:
        return _through(one, frame_of(right), [note_of(i).owner for i in inputs if note_of(i)]), None
    if two is not None:  # rows are turned by the inverse
        return _through(two[::-1], frame_of(left), [note_of(i).owner for i in inputs if note_of(i)]), None
    return None, None


def _through(turn: Any, frame: Any, owners: list[Any]) -> Any:
    source, target = turn
    if frame is not None and frame == target and source != target:
        local = source if isinstance(source, tuple) else target
        owner = next((o for o in owners if o is not None and hasattr(o, "turned")), None)
        if is_turned(local, owner):
            SAID.event("turned_twice", frame=say(frame), source=say(source), target=say(target))
        return None
    return target


def _jacobian(inputs: tuple[Any, ...]) -> None:
    left, right = (labels_of([n]) if (n := note_of(i)) is not None else frozenset() for i in inputs)
    if "angular jacobian" in left and "mju_subQuat" in right and not any("mat" in label for label in left | right):
        SAID.event("local_rotation_error", name="mju_subQuat")


def _degrees(value: Any) -> None:
    note = note_of(value)
    if note is None:
        return
    names = set(note.labels) | ({note.field} if note.field else set())
    radian = names & meaning.RADIANS
    if radian and names <= meaning.RADIANS:
        SAID.event("radians_as_degrees", name=min(radian))


# -- functions of numpy ---------------------------------------------------------------------------------------------


def function(what: Any, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Note | None:
    """The note on what a function of numpy returns."""
    name = what.__name__
    notes = [n for a in args for n in notes_in(a)]
    if not notes:
        return None
    for note in notes:
        if note.pending:
            taken(note)
    result = Note(labels=labels_of(notes), owner=next((n.owner for n in notes if n.owner is not None), None))
    result.epoch = read_at(notes)
    if name in ("copy", "asarray", "ascontiguousarray", "atleast_1d", "array"):
        return notes[0].but(live=False)
    if name == "norm" and notes[0].kind == "quaternion difference":
        SAID.event("quaternion_difference")
    if name == "cross" and len(args) > 1:
        frames = [frame_of(a) for a in args[:2]]
        if differ(frames[0], frames[1], [n.owner for n in notes]):
            tell(frames[0], frames[1], "cross", args[:2])
        result.frame = next((f for f in frames if f is not None), None)
        result.labels |= {"cross"}
    if name in ("clip", "round"):
        result.frame, result.order = frame_of(args[0]), notes[0].order
    if name == "prod" and len(args) == 1:
        half_sizes.product(args[0], result)
    if name in ("dot", "matmul") and len(args) == 2:
        contact_sides.turned(turn_of(args[0]), args[1], result.owner, result)
        result.frame, result.rot = _turned((args[0], args[1]))
    if name == "solve" and len(args) > 1:
        _jacobian((args[0], args[1]))
    if name in ("stack", "vstack", "array", "concatenate", "hstack", "column_stack", "row_stack"):
        same_views(args[0])
    if name in ("reshape", "squeeze"):
        return notes[0].but(at=None)
    return result


def same_views(parts: Any) -> None:
    """Report a collection that holds the same memory more than once, kept at different times."""
    if not isinstance(parts, list | tuple):
        return
    seen: dict[tuple[Any, ...], Note] = {}
    for part in parts[:2000]:
        note = note_of(part) if isinstance(part, Tracked) else None
        if note is None or not note.live or note.at is None or not note.at.size:
            continue
        key = (id(note.owner), note.field, note.at.ravel()[0], note.at.size)
        if key in seen and seen[key].epoch != note.epoch:
            SAID.event("kept_views", note.line, name=note.field)
            return
        seen[key] = note


# -- scalars --------------------------------------------------------------------------------------------------------


def scalar(note: Note, found: Any, at: Any, array: Tracked) -> Any:
    """One element of an array, with its note."""
    if note.pending:
        taken(note.but(at=np.atleast_1d(at)))
    if isinstance(found, np.integer):
        kind = meaning.HOLDS.get(note.field or "") or note.kind
        if note.kind in ("segment id", "segment type"):
            kind = {"segment id": "picture id", "segment type": "picture type"}[note.kind]
        if kind is None:
            return None
        return Index.of(found, kind, Note(line=SAID.line()))
    if isinstance(found, np.floating) and found.dtype == np.float64:
        if note.field == "qpos" and note.live:
            _height(note, int(np.ravel(at)[0]))
        labels = note.labels | ({note.field} if note.field else frozenset())
        half = half_sizes.of(note, at) if note.field is not None else note.half
        if half is not None:
            return Real.of(found, note.but(labels=labels, at=at, live=False, half=half))
        if note.live and note.owner is not None:
            return Real.of(
                found, note.but(labels=labels, at=at, live=False, epoch=note.owner.epoch, time=note.owner.now())
            )
        return Real.of(found, note.but(labels=labels, at=at, live=False))
    return None


def ordered(one: Any, other: Any) -> None:
    """Look at a comparison of two numbers."""
    ray_lengths.compared(one, other)
    angle_sizes.compared(one, other)


def _height(note: Note, place: int) -> None:
    """Report the coordinate of a vertical slide joint that is taken for a height."""
    import made_worlds

    lifted = note.owner.layout.lifts.get(place)
    if lifted is None:
        return
    frame = SAID.frame(2)
    name = frame.f_code.co_name if frame is not None else ""
    if re.search(
        r"height|altitude", name + " " + made_worlds.text_of(SAID.line()).partition("=")[0]
    ) and not made_worlds.says(r"qpos0|\.ref\b|init_z|z0|\bref="):
        SAID.event("displacement_as_height", lifted=round(lifted, 3))


def part(note: Note, array: Tracked, key: Any, at: Any, live: bool) -> Note | None:
    """The note on a part of an array."""
    if note.kind == "segmentation" and isinstance(key, tuple) and isinstance(key[-1], int):
        return note.but(kind=("picture id", "picture type")[key[-1] % 2], at=None, live=False)
    if note.field is not None:
        jacobian_points.taken(note.owner, note.field, at)
    sixes.part(note, array, at)
    if state_columns.part(note, array, key):
        return note.but(at=at, live=live, state=None)
    turn = turn_of(array)
    if turn is not None:
        column = isinstance(key, tuple) and len(key) == 2 and isinstance(key[0], slice) and isinstance(key[1], int)
        row = isinstance(key, int) or (isinstance(key, tuple) and len(key) == 2 and isinstance(key[0], int))
        frame = turn[1] if column else turn[0] if row else None
        return note.but(at=at, live=live, rot=None, frame=frame, picked=SAID.line() if row else 0)
    if note.frame is not None and array.ndim == 1 and array.shape == (3,):
        return note.but(at=at, live=live, frame=None)
    if note.kind in ("xyzw", "wxyz"):
        return note.but(at=None if at is None else at, live=live, kind=None)
    return None


Hooks.index, Hooks.compare, Hooks.ufunc, Hooks.function = index, compare, ufunc, function
Hooks.scalar, Hooks.frame, Hooks.taken = scalar, part, taken
Hooks.shown, Hooks.ordered = ray_lengths.used, ordered
