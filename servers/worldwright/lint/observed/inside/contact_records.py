"""Contacts as a program sees them: each remembers the step it belongs to."""

from typing import Any

import numpy as np
from said import SAID
from tracked import Index, Note, Tracked

INDICES = {"geom1": "geom", "geom2": "geom", "efc_address": "constraint row"}


class Contact:
    """One contact; its values are read from the engine's memory when they are asked for."""

    def __init__(self, state: Any, of: Any, number: int, epoch: int, line: int) -> None:
        object.__setattr__(self, "_given", (state, of, number, epoch, line))

    @property
    def _of(self) -> Any:
        return self._given[1]

    def __getattr__(self, name: str) -> Any:
        state, of, number, epoch, line = self._given
        found = getattr(of, name)
        if name.startswith("_"):
            return found
        if state.epoch != epoch:
            SAID.event("contact_kept", line, read=SAID.line())
        if name in INDICES:
            return Index.of(found, INDICES[name])
        if name in ("frame", "geom") and isinstance(found, np.ndarray):
            array = found.view(Tracked)
            rot = ("world", ("contact", number)) if name == "frame" else None
            array.note = Note(owner=state, rot=rot, kind="geom" if name == "geom" else None, line=SAID.line())
            return array
        return found

    def __setattr__(self, name: str, value: Any) -> None:
        setattr(self._given[1], name, value)


class ContactList:
    """All contacts of one state."""

    def __init__(self, state: Any, of: Any, line: int) -> None:
        self._state, self._of, self._epoch, self._line = state, of, state.epoch, line

    def __len__(self) -> int:
        if self._state.epoch != self._epoch:
            SAID.event("contact_kept", self._line, read=SAID.line())
        return len(self._of)

    def __getitem__(self, key: Any) -> Any:
        if isinstance(key, slice):
            return [self[i] for i in range(len(self._of))[key]]
        if self._state.epoch != self._epoch:
            SAID.event("contact_kept", self._line, read=SAID.line())
        return Contact(self._state, self._of[int(key)], int(key), self._state.epoch, SAID.line())

    def __iter__(self) -> Any:
        if self._state.epoch != self._epoch:
            SAID.event("contact_kept", self._line, read=SAID.line())
        return (self[i] for i in range(len(self._of)))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        found = getattr(self._of, name)
        if name in ("geom", *INDICES) and isinstance(found, np.ndarray) and found.size:
            array = found.view(Tracked)
            array.note = Note(owner=self._state, kind=INDICES.get(name, "geom"), line=SAID.line())
            return array
        return found
