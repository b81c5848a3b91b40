"""Follow the frame in which each vector is given, and from which frame to which a matrix turns."""

from typing import Any

import meaning
import numpy as np
from said import SAID
from tracked import note_of


def layout_of(owner: Any) -> Any:
    """The layout of the coordinates of the model behind an array."""
    return owner.layout if owner is not None else None


def frame_of(value: Any) -> Any:
    """The frame that a vector is given in: "world", (object, id), or None where nothing is known."""
    note = note_of(value)
    if note is None:
        return None
    if note.frame is not None:
        return note.frame
    if note.store is not None and note.at is not None and note.at.size:
        for places, frame in reversed(note.store["frames"]):
            if places >= set(note.at.ravel().tolist()):
                return frame
        return None
    field = note.field
    if field is None or note.at is None or not note.at.size:
        return None
    if field in meaning.WORLD and (value.shape[-1:] == (3,) if isinstance(value, np.ndarray) else False):
        return "world"
    if field in meaning.PER_DOF and isinstance(value, np.ndarray) and value.shape == (3,):
        layout = layout_of(note.owner)
        places = [int(a) for a in note.at.ravel()]
        turning = {layout.turning.get(p) for p in places}
        if len(turning) == 1 and None not in turning:
            return turning.pop()
        return "world" if all(p in layout.linear for p in places) else None
    if field in ("xfrc_applied", "cvel", "cacc", "cfrc_ext", "cfrc_int") and value.shape[-1:] == (3,):
        return "world"
    if field == "sensordata" and isinstance(value, np.ndarray) and value.shape == (3,):
        frames = {layout_of(note.owner).sensor_frame.get(int(a)) for a in note.at.ravel()}
        return frames.pop() if len(frames) == 1 else None
    return None


def turn_of(value: Any) -> Any:
    """(from, to) of a 3 x 3 matrix, or None."""
    note = note_of(value)
    if note is None or not isinstance(value, np.ndarray) or value.shape[-2:] != (3, 3):
        return None
    if note.rot is not None:
        return note.rot
    kind = meaning.TURNS.get(note.field or "")
    if kind is not None and note.at is not None and value.shape == (3, 3):
        local = (kind, int(note.at[0, 0]) // 9)
        return (local, "world") if note.at[0, 1] == note.at[0, 0] + 1 else ("world", local)
    return None


def is_turned(frame: Any, owner: Any) -> bool:
    """Whether a local frame is turned against the world at all; when it is not, mixing them harms nothing yet."""
    if not isinstance(frame, tuple) or owner is None:
        return True
    return owner.turned(frame)


def differ(one: Any, other: Any, owners: list[Any]) -> bool:
    """Whether two vectors are given in different frames, and it matters now."""
    if one is None or other is None or one == other:
        return False
    owner = next((o for o in owners if o is not None and hasattr(o, "turned")), None)
    local = [f for f in (one, other) if isinstance(f, tuple)]
    return any(is_turned(f, owner) for f in local)


def tell(one: Any, other: Any, name: str, values: Any, line: int = 0) -> None:
    """Report that two frames meet; a row of a matrix that was taken for an axis is reported where it was taken, too."""
    SAID.event("mixed_frames", line, one=say(one), other=say(other), name=name)
    for note in map(note_of, values):
        if note is not None and note.picked:
            SAID.event("mixed_frames", note.picked, one=say(one), other=say(other), name="a row of the matrix")


def say(frame: Any) -> str:
    """A frame in words."""
    return frame if isinstance(frame, str) else f"{frame[0]} {frame[1]}" if isinstance(frame, tuple) else "?"
