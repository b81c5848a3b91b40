"""Copying everything that an MjData holds from one process to another, through memory that both see.

MuJoCo keeps all arrays of a data in one allocation (`buffer`), contacts and constraints in a second one (`arena`), and
numbers such as the time, the energy and how many contacts there are in the struct itself. Two processes with the same
compiled model have the same layout, so a copy is a few moves of memory, and whatever a program reads of its own data
(poses, contacts, sensors, the forces of the last step) is what the engine holds, bit for bit, and nothing is computed twice.

Addresses are never sent: the sender gives the offset of each array in its arena, and the receiver adds the address of its
own arena. The struct's layout is read from `mujoco.introspect`, which belongs to the installed build, and is checked
against the live data before it is relied on.
"""

import ctypes
from collections.abc import Mapping, Sequence
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

from .errors import WorldkitError

if TYPE_CHECKING:
    import mujoco
    import numpy as np

LINE = 64
"""Parts of a slot begin at multiples of this many bytes."""
MOST_ARENA = 8 << 20
"""Contacts and constraints beyond this size are not sent: the receiver sees none."""
COUNTS = (("ncon", "nJ"), ("nY", "nisland"))
"""Neighbours in the struct, first and last, that count what lies in the arena."""
NOWHERE = 0xFFFF_FFFF_FFFF_FFFF
"""Stands in place of an offset when the array is not there."""


class MirrorError(WorldkitError):
    """The installed engine does not keep its data as its own description says."""

    code = "engine"


class Slot(NamedTuple):
    """The parts of a slot, as memory: assigning to a view costs a third of what a call of `memmove` does."""

    used: memoryview
    """One number: the length of the used arena."""
    numbers: memoryview
    pointers: memoryview
    buffer: memoryview
    arena: memoryview


class Mirror:
    """Copies an `MjData` to and from slots of `size` bytes.

    Args:
        model, data: what is copied.
        sends: whether it is ever sent. Only then what is free of its arena is blanked, which takes milliseconds.

    A slot holds, in this order: the length of the used arena, the struct's numbers, where the arena's arrays begin, the
    buffer, the used part of the arena.
    """

    def __init__(self, model: "mujoco.MjModel", data: "mujoco.MjData", sends: bool = True) -> None:
        import numpy as np

        self._kept = (model, data)  # their memory must not be given back
        layout, base = struct("mjData"), data._address
        self._live = live = layout.from_address(base)
        _check(live, model, data)
        first, last = layout.solver_niter.offset, layout.energy.offset + layout.energy.size
        self._data_at = base
        self._numbers_at, self._numbers_bytes = base + first, last - first
        begin = layout.contact.offset
        self._pointers, self._pointers_bytes = base + begin, layout.signature.offset - begin
        self.buffer, self.buffer_bytes = int(live.buffer), int(live.nbuffer)
        self._arena, self._room = int(live.arena), min(MOST_ARENA, int(live.narena))
        # What lies between contacts and constraints there is never written: it must not tell what was in memory before.
        if sends:
            ctypes.memset(self._arena + int(live.parena), 0, max(0, self._room - int(live.parena)))
        self._at_numbers = LINE
        self._at_pointers = _round(self._at_numbers + self._numbers_bytes)
        self._at_buffer = _round(self._at_pointers + self._pointers_bytes)
        self._at_arena = _round(self._at_buffer + self.buffer_bytes)
        self.size = _round(self._at_arena + self._room)
        count = self._pointers_bytes // 8
        # The last values on one side of the translation, and what became of them on the other.
        self._seen, self._told = np.zeros(count, np.uint64), np.zeros(count, np.uint64)
        self._seen_at = address(self._seen)
        self._own_numbers = memory(self._numbers_at, self._numbers_bytes)
        self._own_pointers = memory(self._pointers, self._pointers_bytes)
        self._own_buffer, self._own_arena = memory(self.buffer, self.buffer_bytes), memory(self._arena, self._room)
        # Fields of the struct are read and written as memory too: an attribute of ctypes takes three times as long.
        self._used = memory(base + layout.parena.offset, 8).cast("Q")
        self._counts = []
        for first_count, last_count in COUNTS:
            begin, end = getattr(layout, first_count), getattr(layout, last_count)
            size = end.offset + end.size - begin.offset
            self._counts.append((memory(base + begin.offset, size), bytes(size)))
        self._saw, self._said = memory(self._seen_at, 8 * count), memory(address(self._told), 8 * count)
        self._slots: dict[int, Slot] = {}

    def send(self, slot: int) -> None:
        """Copy the data into the slot at this address."""
        used = self._used[0]
        if used > self._room:
            used = 0
        there = self._slots.get(slot) or self._parts(slot)
        there.numbers[:] = self._own_numbers
        there.buffer[:] = self._own_buffer
        if used:
            if differ(self._pointers, self._seen_at, self._pointers_bytes):
                self._saw[:] = self._own_pointers
                self._told[:] = self._seen - self._arena
                self._told[self._seen == 0] = NOWHERE
            there.pointers[:] = self._said
            there.arena[:used] = self._own_arena[:used]
        there.used[0] = used

    def receive(self, slot: int) -> None:
        """Make the data what the slot at this address holds."""
        there = self._slots.get(slot) or self._parts(slot)
        used = there.used[0]
        self._own_numbers[:] = there.numbers
        self._own_buffer[:] = there.buffer
        if 0 < used <= self._room:
            if differ(slot + self._at_pointers, self._seen_at, self._pointers_bytes):
                self._saw[:] = there.pointers
                self._told[:] = self._seen + self._arena
                self._told[self._seen == NOWHERE] = 0
            self._own_pointers[:] = self._said
            self._own_arena[:used] = there.arena[:used]
        else:
            for counts, none in self._counts:
                counts[:] = none
        self._used[0] = used

    def _parts(self, slot: int) -> Slot:
        """The parts of the slot at this address, which is one of a few."""
        self._slots[slot] = parts = Slot(
            memory(slot, 8).cast("Q"),
            memory(slot + self._at_numbers, self._numbers_bytes),
            memory(slot + self._at_pointers, self._pointers_bytes),
            memory(slot + self._at_buffer, self.buffer_bytes),
            memory(slot + self._at_arena, self._room),
        )
        return parts

    def numbers(self, entries: Mapping[str, Any], arrays: Sequence[str]) -> "tuple[np.ndarray, np.ndarray]":
        """(all numbers of the buffer as a view, where in it the entries lie): flat indices by array, in this order."""
        import numpy as np

        view = words(self.buffer, self.buffer_bytes // 8)
        return view, np.concatenate(
            [np.zeros(0, np.intp), *(self.at(name) // 8 + np.array(entries.get(name, ()), np.intp) for name in arrays)]
        )

    def at(self, name: str) -> int:
        """Where an array begins in the buffer, bytes."""
        return int(getattr(self._live, name)) - self.buffer

    @property
    def time_at(self) -> int:
        """Address of the data's own time."""
        return int(self._data_at) + int(struct("mjData").time.offset)

    def time_in(self, slot: int) -> float:
        """The time in the slot at this address, s."""
        return float(ctypes.c_double.from_address(slot + self._at_numbers + self.time_at - self._numbers_at).value)

    def contacts_differ(self, slot: int) -> bool:
        """Whether the data's contacts are no longer those in the slot at this address, which must hold their arena."""
        first, size = int(self._live.contact or 0), int(self._live.ncon) * ctypes.sizeof(struct("mjContact"))
        if not size or first < self._arena or first + size > self._arena + self._room:
            return False
        return bool(differ(slot + self._at_arena + first - self._arena, first, size))

    def buffer_in(self, slot: int) -> int:
        """Address of the buffer's copy in the slot at this address."""
        return slot + self._at_buffer


def _check(live: Any, model: "mujoco.MjModel", data: "mujoco.MjData") -> None:
    """Refuse an engine whose struct does not read as its live data does."""
    import numpy as np

    mine = (live.qpos or 0, live.nbuffer, live.ncon, live.nefc, live.time, *live.energy, live.signature)
    theirs = (
        address(data.qpos) if model.nq else mine[0], model.nbuffer and mine[1], data.ncon, data.nefc, data.time,
        *data.energy, data.signature,
    )  # fmt: skip
    inside = not model.nbody or int(live.buffer) <= address(data.xpos) < int(live.buffer) + int(live.nbuffer)
    if not (np.array_equal(np.array(mine, float), np.array(theirs, float), equal_nan=True) and inside):
        raise MirrorError(
            "the engine's data is not laid out as its own description says", "mjData", "install the pinned mujoco build"
        )


@cache
def struct(name: str) -> Any:
    """The ctypes structure of one of the engine's structs, from the installed build's own description of it."""
    from mujoco.introspect.structs import STRUCTS

    kinds = {
        "mjtNum": ctypes.c_double, "float": ctypes.c_float, "int": ctypes.c_int, "mjtBool": ctypes.c_bool,
        "mjtSize": ctypes.c_int64, "size_t": ctypes.c_size_t, "uintptr_t": ctypes.c_size_t, "uint64_t": ctypes.c_uint64,
    }  # fmt: skip
    fields: list[tuple[str, Any]] = []
    for field in STRUCTS[name].fields:
        kind: Any = ctypes.c_void_p
        if "Pointer" not in type(field.type).__name__:
            inner = str(getattr(field.type, "inner_type", field.type))
            kind = kinds[inner] if inner in kinds else struct(inner)
            for extent in reversed(getattr(field.type, "extents", ())):
                kind = kind * extent
        fields.append((field.name, kind))
    return type(name, (ctypes.Structure,), {"_fields_": fields})


def address(array: "np.ndarray") -> int:
    """Where an array's first number lies in memory."""
    return int(array.__array_interface__["data"][0])


def words(at: int, count: int) -> "np.ndarray":
    """(count,) numbers (float64) at an address, as a view."""
    import numpy as np

    return np.ctypeslib.as_array((ctypes.c_double * count).from_address(at))


def memory(at: int, count: int) -> memoryview:
    """So many bytes at an address, as memory that can be written."""
    return memoryview((ctypes.c_uint8 * count).from_address(at)).cast("B")


def _round(size: int) -> int:
    return -(-size // LINE) * LINE


# Called without releasing the interpreter's lock, which would cost more than the move itself.
_libc = ctypes.PyDLL(None)
move = _libc.memmove
move.argtypes, move.restype = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t), None
differ = _libc.memcmp
differ.argtypes, differ.restype = (ctypes.c_void_p, ctypes.c_void_p, ctypes.c_size_t), ctypes.c_int
