"""Watch what a program writes: into the state, into the model, into arrays of its own."""

from typing import Any

import angle_sizes
import contact_sides
import inputs_held
import meaning
import model_edits
import numpy as np
import quaternion_names
import ray_lengths
import sixes
from frames import tell
from owners import DataState, ModelState
from said import SAID
from tracked import Hooks, Note, Tracked, labels_of, note_of, notes_in, plain
from uses import differ, frame_of, layout_of

INPUT = {"ctrl", "qpos", "qvel", "xfrc_applied", "qfrc_applied", "mocap_pos", "mocap_quat", "act"}
JOINT_FORCES = {"qfrc_bias", "qfrc_inverse", "qfrc_passive", "mj_mulM", "mj_rne", "qfrc_gravcomp"}


def write(array: Tracked, key: Any, value: Any, operation: Any) -> Any:
    """Look at a write before it happens; returns what to do after it, or None."""
    note = array.note
    if note is None:
        return None
    line = SAID.line()
    if operation is not None:
        value = operation[1][1] if len(operation[1]) > 1 else None
    notes = notes_in(value)
    labels = labels_of(notes)
    if not note.live:
        return _write_own_array(array, key, value, note, labels, line, operation)
    owner = note.owner
    places = note.at if key is Ellipsis or note.at is None else note.at[key]
    places = np.asarray(places)
    if isinstance(owner, ModelState):
        if (note.field or "").endswith("quat"):
            quaternion_names.given(value, note.field or "")
        model_edits.wrote(array, key, value, operation, places, line)
        _old, seen = owner.written.get(note.field or "", (line, set()))
        owner.written[note.field or ""] = (line, seen | set(places.ravel().tolist()[:5000]))
        owner.told.discard("setConst")
        return None
    if not isinstance(owner, DataState) or note.field is None:
        return None
    if operation is None or operation[0].__name__ in ("add", "subtract"):
        sixes.forces(note.field, places, line)
    if operation is not None and operation[0].__name__ == "add":
        quaternion_names.added(note, places, value, line)
    ray_lengths.used(value)
    if operation is None:
        _report_self_assignment(array, key, value, note, line)
    if note.field == "qpos":
        _report_nudge(array, key, value, note, line)
    if note.field in ("ctrl", *inputs_held.FORCES):
        added = operation is not None and operation[0].__name__ in ("add", "subtract")
        added |= operation is None and note.field in labels and not (isinstance(value, Tracked) and value.note.live)
        inputs_held.wrote(owner, note.field, places, value, labels, line, added)
    if note.field in INPUT:
        _into_state(owner, note, places, value, labels, line, operation)
    if operation is None:
        _frames(array, key, value, note, places, line)
    owner.wrote(note.field, line)
    owner.writes[note.field] = owner.writes.get(note.field, 0) + 1
    note.writes += 1
    return None


def _report_self_assignment(array: Tracked, key: Any, value: Any, note: Note, line: int) -> None:
    other = note_of(value)
    if other is None or not isinstance(value, Tracked) or not other.live or other.owner is not note.owner:
        return
    target = note.at if key is Ellipsis else note.at[key]
    same = other.field == note.field and other.at is not None and np.array_equal(np.asarray(target), other.at)
    written = note.owner.writes.get(note.field, 0) > other.writes
    if same and other.line != line and (other.epoch != note.epoch or note.owner.epoch > other.epoch or written):
        SAID.event("copied_onto_itself", line, name=note.field, kept=other.line)


def _into_state(
    owner: DataState, note: Note, places: Any, value: Any, labels: frozenset[str], line: int, operation: Any
) -> None:
    field = note.field or ""
    if "wall clock" in labels:
        SAID.event("wall_clock", line, name=field)
    whole = places.size == owner.size(field)
    other = note_of(value)
    if field == "ctrl":
        layout = layout_of(owner)
        ordered = other is not None and other.order in ("dof", "qpos") and whole and places.size > 1
        if ordered and other is not None and layout.same("ctrl", other.order or "") is False:
            SAID.event("control_order", line, order=other.order)
        if labels & JOINT_FORCES and not {"actuator_gear", "actuator_moment"} & labels:
            _report_missing_gear(owner, line)
    if field == "qpos":
        owner.free_written.update(int(p) for p in np.ravel(places)[:2000])
    if field == "qpos" and operation is None and whole and other is not None and other.field == "key_qpos":
        owner.from_key = (
            (line, int(np.ravel(other.at)[0]) // max(owner.model.of.nq, 1)) if other.at is not None else None
        )
    if field == "qpos" and operation is None:
        if whole and places.size:
            owner.fresh_start, owner.start_line = True, line
        _quaternion(owner, places, value, line)
        quaternion_names.norm(owner, places, plain(value), labels, line)
    if field in ("qpos", "ctrl") and operation is None:
        angle_sizes.wrote(owner, field, places, value, labels, line)
    if field == "mocap_quat" and other is not None and other.kind == "xyzw":
        SAID.event("quaternion_order", line, name=field)


def _report_missing_gear(owner: DataState, line: int) -> None:
    from owners import raw

    model = owner.model.of
    gear, gain = raw(model, "actuator_gear")[:, 0], raw(model, "actuator_gainprm")[:, 0]
    motors = (raw(model, "actuator_biastype") == 0) & (raw(model, "actuator_trntype") == 0)
    scaled = motors & (np.abs(gear * gain - 1.0) > 1e-6)
    if scaled.any():
        SAID.event("gear_ignored", line, gear=float(gear[scaled][0]))


def _quaternion(owner: DataState, places: Any, value: Any, line: int) -> None:
    other = note_of(value)
    here = frozenset(int(p) for p in np.ravel(places))
    if other is not None and other.kind == "xyzw" and here in owner.layout.quats:
        SAID.event("quaternion_order", line, name="qpos")


def _thrust(note: Note, value: Any, places: Any, notes: list[Note], line: int) -> None:
    """Report a force along the body's own axis, given to an array of world-frame forces."""
    import made_worlds

    force = np.ravel(np.asarray(plain(value), float))
    body = int(np.ravel(places)[0]) // 6
    if force.size not in (3, 6) or np.ravel(places)[0] % 6 or not force[2] or force[:2].any():
        return
    if (
        note.owner.turned(("body", body))
        and made_worlds.says(r"thrust|rotor|propell|jet\b")
        and not made_worlds.says(r"xmat|xquat|rotVecQuat|from_quat|quat2Mat|as_matrix")
    ):
        SAID.event("body_force", line)


def _frames(array: Tracked, key: Any, value: Any, note: Note, places: Any, line: int) -> None:
    if note.field == "xfrc_applied" and places.size in (3, 6):
        _thrust(note, value, places, notes_in(value), line)
    frame = frame_of(value)
    if frame is None or np.size(value) != 3:
        return
    target = None
    if note.field in ("xfrc_applied", "mocap_pos"):
        target = "world"
    elif note.field in meaning.PER_DOF and places.size == 3:
        turning = {note.owner.layout.turning.get(int(p)) for p in places.ravel()}
        target = turning.pop() if len(turning) == 1 else None
        if target is None and all(int(p) in note.owner.layout.linear for p in places.ravel()):
            target = "world"
    if differ(frame, target, [note.owner, *[n.owner for n in notes_in(value)]]):
        tell(frame, target, f"data.{note.field}", [value], line)


def _write_own_array(
    array: Tracked, key: Any, value: Any, note: Note, labels: frozenset[str], line: int, operation: Any
) -> Any:
    """Look at a write into an array of the program's own."""
    if (
        note.field is not None
        and note.order != "own"
        and operation is None
        and note.kind == "picked"
        and note.line == line
    ):
        SAID.event("written_to_copy", line, name=note.field)
    _report_nudge(array, key, value, note, line)
    ray_lengths.used(value)
    if operation is not None and operation[0].__name__ == "add" and note.at is not None:
        quaternion_names.added(note, note.at if key is Ellipsis else note.at[key], value, line)
    if note.store is None:
        if note.field is not None and operation is None:
            note.labels |= labels
        return None
    note.store["labels"] |= labels
    contact_sides.kept(note.store, operation[0].__name__ if operation is not None else "", value)
    frame = frame_of(value)
    if note.at is not None:
        places = frozenset(np.ravel(note.at if key is Ellipsis else note.at[key]).tolist())
        kept = [f for f in note.store["frames"] if not f[0] <= places]
        if operation is not None and operation[0].__name__ in ("add", "subtract"):
            mine = frame_of(array)
            if differ(mine, frame, [n.owner for n in notes_in(value)]):
                tell(mine, frame, "sum", [value], line)
            frame = frame or mine
        if operation is None or frame is not None:
            note.store["frames"] = [*kept, (places, frame)] if frame is not None else kept
    return None


def _report_nudge(array: Tracked, key: Any, value: Any, note: Note, line: int) -> None:
    """Report one component of a quaternion that is changed by a little, as a difference quotient would."""
    if note.at is None or note.field not in ("qpos", "qpos0", "key_qpos") or not isinstance(key, int | np.integer):
        return
    layout = layout_of(note.owner)
    place = int(np.ravel(note.at[key])[0]) % max(note.owner.layout.model.nq, 1)
    change = abs(float(plain(value)) - float(plain(array)[key])) if np.size(value) == 1 else 1.0
    if place in layout.in_quat and 0 < change <= 1e-3:
        SAID.event("quaternion_nudged", line)


Hooks.write = write
