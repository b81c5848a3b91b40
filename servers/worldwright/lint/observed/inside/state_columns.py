"""Watch the columns of state vectors: time stands before the positions."""

import re
from typing import Any

import called_names
import mujoco
import numpy as np
from owners import CALL
from said import SAID
from tracked import Note, Tracked, note_of, plain

Columns = tuple[tuple[str, int, int], ...]


def columns(model: Any, bits: int) -> Columns:
    """(name, start, stop) of each part of a state vector."""
    found, start = [], 0
    for name, member in sorted(mujoco.mjtState.__members__.items(), key=lambda m: int(m[1])):
        bit = int(member)
        if bit and bit & (bit - 1) == 0 and bits & bit and name.startswith("mjSTATE_") and name != "mjNSTATE":
            size = int(CALL["mj_stateSize"](model, bit))
            found.append((name.removeprefix("mjSTATE_").lower(), start, start + size))
            start += size
    return tuple(found)


def got(state: Any, given: tuple[Any, ...], everything: list[Any]) -> None:
    """Note the columns of a state that was written into an array of the program's own."""
    bits = next((int(g) for g in everything[::-1] if not isinstance(g, np.ndarray | mujoco.MjData | mujoco.MjModel)), 0)
    for array in given:
        note = note_of(array)
        if isinstance(array, Tracked) and note is not None and note.store is not None:
            note.store["state"] = columns(state.model.of, bits)


def rolled(model: Any, found: Any) -> Any:
    """The result of rollout, with a note."""
    if isinstance(model, list | tuple) and model:
        model = model[0]
    if not isinstance(model, mujoco.MjModel) or not isinstance(found, tuple) or not isinstance(found[0], np.ndarray):
        return found
    states = found[0].view(Tracked)
    states.note = Note(state=columns(model, int(mujoco.mjtState.mjSTATE_FULLPHYSICS)))
    return (states, *found[1:])


def part(note: Note, array: Any, key: Any) -> bool:
    """Look at a part that is taken of a state vector; returns whether it no longer is one."""
    state = note.state or (note.store.get("state") if note.store is not None else None)
    if not state or array.shape[-1] != state[-1][2]:
        return False
    parts = key if isinstance(key, tuple) else (key,)
    if any(p is Ellipsis for p in parts):
        last = parts[-1] if parts[-1] is not Ellipsis else None
    else:
        last = parts[-1] if len(parts) == array.ndim else None
    if last is None:
        return False
    sizes = {name: stop - start for name, start, stop in state}
    nq, nv = sizes.get("qpos", 0), sizes.get("qvel", 0)
    if state[0][0] == "time" and isinstance(last, int) and last == 0 and array.ndim > 1 and nq:
        name = called_names.column(SAID.line())
        if name and not re.search(r"(?<![a-z])t[0-9s]?(?![a-z])|time|clock|stamp", name):
            SAID.event("time_first", SAID.line(), qpos=f"{1}:{1 + nq}", qvel=f"{1 + nq}:{1 + nq + nv}")
    if state[0][0] != "time" or not isinstance(last, slice) or not nq or not nv:
        return True
    first, stop = last.start or 0, last.stop
    if (first == 0 and stop == nq) or (first == nq and nq > 1 and stop in (None, nq + nv) and array.shape[-1] > nq + 1):
        SAID.event("time_first", SAID.line(), qpos=f"{1}:{1 + nq}", qvel=f"{1 + nq}:{1 + nq + nv}")
    return True


def install() -> None:
    """Watch rollouts."""
    try:
        from mujoco import rollout
    except ImportError:
        return
    original = rollout.rollout

    def run(*given: Any, **named: Any) -> Any:
        found = original(*map(plain, given), **{k: plain(v) for k, v in named.items()})
        return rolled(given[0] if given else named.get("model"), found)

    rollout.rollout = run
    method = rollout.Rollout.rollout

    def again(self: Any, *given: Any, **named: Any) -> Any:
        found = method(self, *map(plain, given), **{k: plain(v) for k, v in named.items()})
        return rolled(given[0] if given else named.get("model"), found)

    rollout.Rollout.rollout = again
