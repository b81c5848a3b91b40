"""Whole numbers that remember what they count."""

from typing import Any

import numpy as np
from note import Hooks, Note, safe


class Index(int):
    """A whole number that remembers what it counts."""

    note: Note | None = None

    @classmethod
    def of(cls, value: Any, kind: str, note: Note | None = None) -> "Index":
        """The value as an index of a kind."""
        made = cls(int(value))
        made.note = note.but(kind=kind) if note is not None else Note(kind=kind)
        return made

    def __add__(self, other: Any) -> Any:
        return (
            self._moved(int.__add__(self, int(other)), other) if isinstance(other, int | np.integer) else NotImplemented
        )

    def __radd__(self, other: Any) -> Any:
        return self.__add__(other)

    def __sub__(self, other: Any) -> Any:
        if not isinstance(other, int | np.integer):
            return NotImplemented
        return self._moved(int(self) - int(other), other)

    def _moved(self, value: int, other: Any) -> Any:
        from meaning import ADDRESSES

        same = isinstance(other, Index)
        kind = self.note.kind if self.note is not None else None
        return Index.of(value, kind) if kind in ADDRESSES and not same else int(value)

    def __eq__(self, other: object) -> bool:
        if isinstance(other, Index):
            safe(Hooks.compare, self.note, other.note)
        if isinstance(other, np.ndarray):
            return NotImplemented
        return int.__eq__(self, other)

    def __hash__(self) -> int:
        return int.__hash__(self)

    def __reduce__(self) -> Any:
        return (int, (int(self),))

    def item(self) -> int:
        """As numpy's."""
        return int(self)

    @property
    def dtype(self) -> Any:
        """As numpy's."""
        return np.dtype(np.int32)

    @property
    def shape(self) -> tuple[int, ...]:
        """As numpy's."""
        return ()

    def astype(self, kind: Any) -> Any:
        """As numpy's."""
        return np.asarray(int(self)).astype(kind)[()]
