"""What is known about a number beside its value, and the hooks that are called at every use."""

from typing import Any

from said import SAID


class Note:
    """What is known about an array or a number."""

    __slots__ = ("at", "born", "clipped", "delta", "epoch", "field", "flipped", "frame", "half", "kind", "labels", "line", "live", "made", "order", "owner", "pending", "picked", "rot", "sides", "since", "state", "store", "time", "writes")  # fmt: skip

    def __init__(self, **given: Any) -> None:
        self.field: str | None = None
        """The engine's array that this is a part, or a copy, of."""
        self.owner: Any = None
        self.at: Any = None
        """Flat index into that array of each element."""
        self.live = False
        """The value shares memory with the engine."""
        self.epoch = 0
        """How often the owner had been stepped when this was read."""
        self.frame: Any = None
        self.rot: Any = None
        """(from, to) of a matrix that turns vectors."""
        self.kind: str | None = None
        """The kind of thing that an index counts, or the order of a quaternion's numbers."""
        self.order: str | None = None
        """The kind of thing that orders the elements of a vector."""
        self.labels: frozenset[str] = frozenset()
        """Names of the values that went into it."""
        self.line = 0
        self.born = 0
        """The line that named the engine's array."""
        self.store: Any = None
        """Frames of parts of a program's own array, shared by its views."""
        self.time: Any = None
        """Simulated time when it was read, s."""
        self.pending = False
        """It is judged when the value is read, not when it is named."""
        self.half: Any = None
        """The half extents that it is, or whose product it is."""
        self.made: Any = None
        """The place where several half extents were multiplied into it."""
        self.sides: Any = None
        """(first geom, second geom, sign, line) of the contact forces in it."""
        self.flipped = False
        """Its sign was turned."""
        self.state: Any = None
        """Columns of a state vector: (name, start, stop)."""
        self.picked = 0
        """The line that took it as a row of a matrix."""
        self.writes = 0
        """How often the array was written before this was taken, and through this since."""
        self.since: Any = None
        """(model, version) of a value that was taken from a model."""
        self.clipped = False
        """It was written as a control, and the engine clips it."""
        self.delta: Any = None
        """Simulated time between the two values whose difference it is, s."""
        for key, value in given.items():
            setattr(self, key, value)

    def but(self, **given: Any) -> "Note":
        """The same note with changes."""
        other = Note()
        for key in Note.__slots__:
            setattr(other, key, getattr(self, key, None))
        for key, value in given.items():
            setattr(other, key, value)
        return other


class Hooks:
    """Called at every use of a value; `uses.py` and `writes.py` set them."""

    index: Any = None
    write: Any = None
    ufunc: Any = None
    function: Any = None
    scalar: Any = None
    frame: Any = None
    compare: Any = None
    taken: Any = None
    shown: Any = None
    ordered: Any = None


def safe(hook: Any, *given: Any) -> Any:
    """A hook must never change what the program does."""
    if hook is None:
        return None
    try:
        return hook(*given)
    except Exception:
        if SAID.seen is None:
            raise
        import os

        if os.environ.get("WORLDWRIGHT_OBSERVED_DEBUG"):
            import traceback

            traceback.print_exc()
        return None
