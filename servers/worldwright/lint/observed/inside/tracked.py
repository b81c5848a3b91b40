"""Arrays, scalars and indices that remember where they come from and carry their meaning through a program.

Each is what the engine returned, with a note. Whatever a program does with it gives the same values as without a note:
every operation works on the plain arrays, and only its result is noted.
"""

from typing import Any

import numpy as np
from note import Hooks, Note, safe
from said import SAID
from whole_numbers import Index


def plain(value: Any) -> Any:
    """A value, or a nest of values, without notes."""
    if isinstance(value, Tracked):
        return value.view(np.ndarray)
    if isinstance(value, Real):
        return np.float64(value)
    if isinstance(value, Index):
        return int(value)
    if type(value) is tuple:
        return tuple(map(plain, value))
    if type(value) is list:
        return [plain(v) for v in value]
    if type(value) is dict:
        return {k: plain(v) for k, v in value.items()}
    return value


def note_of(value: Any) -> Note | None:
    """The note of a value, or None."""
    return value.note if isinstance(value, Tracked | Real | Index) else None


def notes_in(value: Any, depth: int = 0) -> list[Note]:
    """The notes of a value and of what it holds."""
    if isinstance(value, Tracked | Real | Index):
        return [value.note] if value.note is not None else []
    if isinstance(value, list | tuple) and depth < 3 and len(value) < 10000:
        return [n for v in value for n in notes_in(v, depth + 1)]
    return []


def labels_of(notes: list[Note]) -> frozenset[str]:
    """Everything that went into any of them."""
    found: frozenset[str] = frozenset()
    for note in notes:
        if not note.labels <= found:
            found |= note.labels
        if note.store is not None and note.store["labels"]:
            found |= note.store["labels"]
    return found


class Tracked(np.ndarray):
    """An array with a note."""

    note: Note | None = None

    def __array_finalize__(self, of: Any) -> None:
        self.note = None

    def __getitem__(self, key: Any) -> Any:
        note = self.note
        if note is None:
            return super().__getitem__(plain(key))
        if note.field is not None:
            key = self._seen(key, False)
        bare = plain(key)
        found = super().__getitem__(bare)
        if isinstance(found, Tracked):
            live = note.live and found.base is not None and np.may_share_memory(plain(found), plain(self))
            at = note.at[bare] if note.at is not None else None
            whole = isinstance(bare, slice) and found.shape == self.shape
            found.note = safe(Hooks.frame, note, self, bare, at, live) or note.but(
                at=at, live=live, rot=None, order=note.order if whole else None
            )
            found.note.line = SAID.line() if note.live else note.line
            if note.live and not live and note.owner is not None:
                found.note.epoch, found.note.time = note.owner.epoch, note.owner.now()
            if note.live and not live and found.note.kind is None:
                found.note.kind = "picked"
            if note.pending and not live:
                safe(Hooks.taken, found.note)
            return found
        if isinstance(found, np.integer | np.floating):
            at = note.at[bare] if note.at is not None else None
            noted_number = safe(Hooks.scalar, note, found, at, self)
            return found if noted_number is None else noted_number
        return found

    def _seen(self, key: Any, writing: bool) -> Any:
        safe(Hooks.index, self, key, writing)
        return key

    def __setitem__(self, key: Any, value: Any) -> None:
        note = self.note
        if note is None:
            super().__setitem__(plain(key), plain(value))
            return
        if note.field is not None:
            self._seen(key, True)
        bare = plain(key)
        before = safe(Hooks.write, self, bare, value, None)
        super().__setitem__(bare, plain(value))
        if before is not None:
            safe(before)

    def __iter__(self) -> Any:
        return (self[i] for i in range(len(self))) if self.ndim else super().__iter__()

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, out: Any = None, **more: Any) -> Any:
        bare = [plain(i) for i in inputs]
        after = None
        if out is not None:
            if isinstance(out[0], Tracked) and out[0].note is not None:
                after = safe(Hooks.write, out[0], Ellipsis, None, (ufunc, inputs))
            more["out"] = tuple(plain(o) for o in out)
        where = more.get("where")
        if where is not None:
            more["where"] = plain(where)
        note = safe(Hooks.ufunc, ufunc, method, inputs) if method in ("__call__", "reduce") else None
        found = getattr(ufunc, method)(*bare, **more)
        if out is not None:
            if after is not None:
                safe(after)
            if isinstance(out[0], Tracked) and out[0].note is not None and note is not None:
                _into(out[0], note)
            return out[0] if len(out) == 1 else out
        return noted(found, note)

    def __array_function__(self, function: Any, types: Any, args: Any, kwargs: Any) -> Any:
        note = safe(Hooks.function, function, args, kwargs)
        out = kwargs.get("out")
        bare_kwargs = {k: plain(v) for k, v in kwargs.items()}
        found = function(*[plain(a) for a in args], **bare_kwargs)
        if isinstance(out, Tracked):
            return out
        if isinstance(found, tuple | list):
            return type(found)(noted(f, note) for f in found) if type(found) in (tuple, list) else found
        return noted(found, note)

    def _kept(self, found: Any, at: Any, live: bool, **more: Any) -> Any:
        if isinstance(found, Tracked) and self.note is not None:
            found.note = self.note.but(at=at, live=live, **more)
        return found

    def reshape(self, *shape: Any, **more: Any) -> Any:
        """As numpy's; a matrix stays a matrix."""
        found = super().reshape(*map(plain, shape), **more)
        note = self.note
        at = note.at.reshape(found.shape) if note is not None and note.at is not None else None
        return self._kept(found, at, note is not None and note.live)

    def copy(self, order: Any = "C") -> Any:
        """As numpy's."""
        if self.note is not None and self.note.pending:
            safe(Hooks.taken, self.note)
        found = super().copy(order)
        out = self._kept(found, None if self.note is None else self.note.at, False, store=_copied(self.note))
        if self.note is not None and self.note.live:
            out.note.line = SAID.line()
            if self.note.owner is not None:
                out.note.epoch, out.note.time = self.note.owner.epoch, self.note.owner.now()
        return out

    def astype(self, *given: Any, **more: Any) -> Any:
        """As numpy's."""
        found = super().astype(*given, **more)
        return self._kept(found, None if self.note is None else self.note.at, False)

    def flatten(self, order: Any = "C") -> Any:
        """As numpy's."""
        return self.copy().reshape(-1) if order == "C" else super().flatten(order)

    def ravel(self, order: Any = "C") -> Any:
        """As numpy's."""
        return self.reshape(-1) if order == "C" else super().ravel(order)

    def transpose(self, *axes: Any) -> Any:
        """As numpy's; a turn becomes its inverse."""
        found = super().transpose(*axes)
        note = self.note
        if isinstance(found, Tracked) and note is not None:
            rot = note.rot[::-1] if note.rot is not None and self.ndim == 2 else None
            at = note.at.transpose(*axes) if note.at is not None else None
            found.note = note.but(rot=rot, at=at)
        return found

    @property
    def T(self) -> Any:  # noqa: N802
        """As numpy's."""
        return self.transpose()

    def dot(self, other: Any, out: Any = None) -> Any:
        """As numpy's, by way of the operator."""
        return np.matmul(self, other) if out is None and np.ndim(other) and self.ndim else super().dot(plain(other))

    def mean(self, *a: Any, **k: Any) -> Any:
        """As numpy's, without notes."""
        return plain(self).mean(*a, **{x: plain(y) for x, y in k.items()})

    def __reduce__(self) -> Any:
        return self.view(np.ndarray).copy().__reduce__()

    def __deepcopy__(self, memo: Any) -> Any:
        return self.copy()

    def __float__(self) -> float:
        return float(self.view(np.ndarray))

    def _shown(self) -> Any:
        if self.note is not None and self.note.pending:
            safe(Hooks.taken, self.note)
        return self.view(np.ndarray)

    def __repr__(self) -> str:
        return repr(self._shown())

    def __str__(self) -> str:
        return str(self._shown())


def _copied(note: Note | None) -> Any:
    if note is None or note.store is None:
        return None
    return {"frames": list(note.store["frames"]), "labels": note.store["labels"]}


def _into(target: Tracked, note: Note) -> None:
    """Pass a note on to an array that an operation wrote in place."""
    mine = target.note
    assert mine is not None
    if mine.live:
        return
    mine.labels |= note.labels
    if note.frame is not None:
        mine.frame = note.frame
    if mine.store is not None:
        mine.store["labels"] |= note.labels


def noted(found: Any, note: Note | None) -> Any:
    """A result with its note."""
    if note is None:
        return found
    if isinstance(found, np.ndarray):
        if found.dtype.kind not in "fiub":
            return found
        tracked = found.view(Tracked)
        tracked.note = note
        return tracked
    if isinstance(found, np.floating | float) and (note.labels or note.delta is not None or note.kind):
        return Real.of(found, note)
    return found


class Real(np.float64):
    """A number with a note."""

    note: Note | None = None

    @classmethod
    def of(cls, value: Any, note: Note | None) -> "Real":
        """The value with a note."""
        made = cls(float(value))
        made.note = note
        return made

    def __array_ufunc__(self, ufunc: Any, method: str, *inputs: Any, **more: Any) -> Any:
        if any(isinstance(i, Tracked) for i in (*inputs, *(more.get("out") or ()))):
            out = more.pop("out", None)
            return Tracked.__array_ufunc__(inputs[0], ufunc, method, *inputs, out=out, **more)
        note = safe(Hooks.ufunc, ufunc, method, inputs) if method == "__call__" else None
        found = getattr(ufunc, method)(*map(plain, inputs), **more)
        return noted(found, note)

    def __reduce__(self) -> Any:
        return (float, (float(self),))

    def __repr__(self) -> str:
        return repr(np.float64(self))

    def __str__(self) -> str:
        return str(np.float64(self))

    def copy(self, order: Any = "C") -> "Real":
        """As numpy's; a number does not change."""
        return self

    def item(self, *_: Any) -> "Real":
        """As numpy's."""
        return self

    def __format__(self, how: str) -> str:
        safe(Hooks.shown, self)
        return format(np.float64(self), how)

    def __lt__(self, other: Any) -> Any:
        safe(Hooks.ordered, self, other)
        return np.float64(self) < plain(other)

    def __le__(self, other: Any) -> Any:
        safe(Hooks.ordered, self, other)
        return np.float64(self) <= plain(other)

    def __gt__(self, other: Any) -> Any:
        safe(Hooks.ordered, self, other)
        return np.float64(self) > plain(other)

    def __ge__(self, other: Any) -> Any:
        safe(Hooks.ordered, self, other)
        return np.float64(self) >= plain(other)

    def __abs__(self) -> Any:
        return noted(abs(np.float64(self)), safe(Hooks.ufunc, np.absolute, "__call__", (self,)))

    def __round__(self, digits: Any = None) -> Any:
        return round(np.float64(self), digits) if digits is not None else round(float(self))


def _operator(name: str, ufunc: Any, back: bool) -> Any:
    def operate(self: Real, other: Any) -> Any:
        if isinstance(other, np.ndarray | list | tuple):
            pair = (other, self) if back else (self, other)
            return ufunc(*pair) if isinstance(other, np.ndarray) else ufunc(*map(np.asarray, map(plain, pair)))
        if not isinstance(other, int | float | np.number):
            return NotImplemented
        pair = (other, self) if back else (self, other)
        note = safe(Hooks.ufunc, ufunc, "__call__", pair)
        return noted(ufunc(*map(plain, pair)), note)

    return operate


for _name, _ufunc in (
    ("add", np.add),
    ("sub", np.subtract),
    ("mul", np.multiply),
    ("truediv", np.true_divide),
    ("pow", np.power),
):
    setattr(Real, f"__{_name}__", _operator(_name, _ufunc, False))
    setattr(Real, f"__r{_name}__", _operator(_name, _ufunc, True))
Real.__neg__ = lambda self: Real.of(-float(self), self.note)  # type: ignore[method-assign]
