"""Watch the engine's arrays: what a program reads from them carries notes."""

import sys
from typing import Any

import meaning
import numpy as np
import owners
import writes
from contact_records import ContactList
from owners import OWNERS, RAW, DataState
from said import SAID
from tracked import Index, Note, Tracked, plain, safe


class Enough(BaseException):
    """Stops the run: it has shown enough."""


class Progress:
    """How far the program may go, in steps of the engine."""

    steps = 0
    most = 60_000
    reads = 0
    most_reads = 600_000
    main = 0


LABELS: dict[str, frozenset[str]] = {}


def here() -> bool:
    """Whether the program itself asks, and not a library."""
    return sys._getframe(2).f_code.co_filename == SAID.program


def tracked(state: Any, name: str, found: Any, line: int) -> Any:
    """One of the engine's arrays with its note."""
    Progress.reads += 1
    owners.READ.add(name)
    if Progress.reads > Progress.most_reads:
        raise Enough
    array = found.view(Tracked)
    time = raw_time(state)
    array.note = Note(field=name, owner=state, at=state.indices(name, found.shape), live=True, epoch=state.epoch,
        line=line, born=line, time=time, labels=LABELS.get(name) or LABELS.setdefault(name, frozenset((name,))),
        writes=state.writes.get(name, 0) if isinstance(state, DataState) else 0,
        since=None if isinstance(state, DataState) else (id(state), state.version),
        pending=isinstance(state, DataState) and (bool(state.dirty) or bool(state.partial) or name in owners.ON_DEMAND or name == "cvel"))  # fmt: skip
    return array


class Attention:
    """Decides when to look: long loops now and then, whole steps at a time; new or rare lines always."""

    tick = 0
    until = 400
    rare = 60
    seen: dict[int, int] = {}


def tired(line: int, owner: Any, name: str) -> bool:
    """Whether to look away this time; the field is then remembered as read unwatched."""
    times = Attention.seen[line] = Attention.seen.get(line, 0) + 1
    if times == 1:
        Attention.until = max(Attention.until, Attention.tick + 100)
    if times <= Attention.rare or Attention.tick < Attention.until or Attention.tick % 64 < 4:
        return False
    state = OWNERS.get(id(owner))
    if isinstance(state, DataState):
        state.blind.add(name)
    return True


def raw_time(state: Any) -> Any:
    """Simulated time, s."""
    return owners.raw(state.of, "time") if isinstance(state, DataState) else None


def _read(state: Any, name: str, line: int, at: Any = None) -> None:
    if not isinstance(state, DataState):
        if name.startswith("key_"):
            state.key_used = True
        safe(owners.constants, state, name, line)


def watch_fields(cls: type, states: Any) -> None:
    """Watch every array of a class."""
    for name, prop in list(vars(cls).items()):
        if type(prop) is property:
            RAW[(cls, name)] = prop
    for (owner, name), prop in list(RAW.items()):
        if owner is cls and name not in ("model", "signature", "ptr"):
            setattr(cls, name, _watched(prop, name, states))


def _watched(prop: property, name: str, states: Any) -> property:
    counts = meaning.KIND_OF_SIZE.get(name)

    def get(self: Any) -> Any:
        found = prop.fget(self)  # type: ignore[misc]
        if sys._getframe(1).f_code.co_filename != SAID.program:
            return found
        if isinstance(found, np.ndarray):
            line = sys._getframe(1).f_lineno
            if tired(line, self, name):
                return found
            state = safe(states, self)
            if state is None:
                return found
            _read(state, name, line)
            return tracked(state, name, found, line)
        if name in ("ncon", "contact") and (state := safe(states, self)) is not None:
            safe(state.contacts, sys._getframe(1).f_lineno)
        if counts is not None and type(found) is int:
            return Index.of(found, "count " + counts)
        if name == "contact":
            state = safe(states, self)
            return ContactList(state, found, SAID.line()) if state is not None else found
        return found

    def put(self: Any, value: Any) -> None:
        if sys._getframe(1).f_code.co_filename == SAID.program:
            old = prop.fget(self)  # type: ignore[misc]
            state = safe(states, self)
            if isinstance(old, np.ndarray) and state is not None:
                safe(writes.write, tracked(state, name, old, SAID.line()), Ellipsis, value, None)
            elif state is not None and name == "time":
                state.since_step.add("time")
        prop.fset(self, plain(value))  # type: ignore[misc]

    return property(get, put if prop.fset is not None else None, doc=prop.__doc__)
