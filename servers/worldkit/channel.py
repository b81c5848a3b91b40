"""Two processes that take turns: memory that both share, and two pipes by which each wakes the other.

Two numbers in the memory, which only grow, show whose turn it is. A waiting process watches the other's number for some tens
of microseconds, and then sleeps on a pipe until the other writes to it: on free processors a turn costs less than a
microsecond, on busy ones no more than a wake-up. After watching in vain, a process sleeps at once for a while.

The memory is laid out by the engine, which makes it as large as it needs and seals its size, so that the other end cannot
take it away under its feet.
"""

import contextlib
import ctypes
import fcntl
import json
import mmap
import os
import select
import time
from typing import Any

from .errors import WorldkitError

ENGINE, AUTHOR = 0, 1
HEAD = 4096
"""Bytes before the messages of the two."""
TURN, SLEEPS = (0, 8), (16, 24)
"""Offsets of the turn counters and of the sleeping marks in the head, on cache lines of their own."""
LOOKS = 1200
"""How often the other's number is read before sleeping: about 50 microseconds."""
MOST_PAUSE = 256
NAP_MS = 20
"""Longest sleep at a time, ms: a missed wake-up costs no more."""
MOST_GREETING = 64 << 20
ENDED = "the process at the other end has ended"
REMEDY = "read its last message; let worldkit.program do the talking"


class PeerError(WorldkitError):
    """The process at the other end has ended, does not answer, or sends what makes no sense."""

    code = "author"


class Channel:
    """One end. Descriptors are owned and closed here.

    Args:
        descriptors: of the shared memory, and of the pipes that this end reads and writes.
        side: `ENGINE` or `AUTHOR`.
    """

    def __init__(self, descriptors: tuple[int, int, int], side: int) -> None:
        self._memory, reading, writing = descriptors
        self._read, self._write, self._side = reading, writing, side
        os.set_blocking(reading, False)
        self._poll = select.poll()
        self._poll.register(reading, select.POLLIN)
        self._map: mmap.mmap | None = None
        self._words: Any = None
        self._heard = b""
        self.base = 0
        self._pause = self._resting = 0
        self._looks = LOOKS if len(_processors()) > 1 else 0

    def size(self, size: int) -> None:
        """Make the memory this large, once and for all; the engine does this."""
        os.ftruncate(self._memory, size)
        with contextlib.suppress(OSError, AttributeError):  # what is no memfd cannot be sealed
            fcntl.fcntl(self._memory, fcntl.F_ADD_SEALS, fcntl.F_SEAL_SHRINK | fcntl.F_SEAL_GROW | fcntl.F_SEAL_SEAL)
        self.map()

    def map(self) -> None:
        """Map the memory; `base` is then its address."""
        self._map = mmap.mmap(self._memory, os.fstat(self._memory).st_size)
        self._words = memoryview(self._map)[:HEAD].cast("Q")
        self.base = ctypes.addressof(ctypes.c_char.from_buffer(self._map))

    def greet(self, message: dict[str, Any]) -> None:
        """Send one message before the first turn."""
        data = json.dumps(message).encode() + b"\n"
        os.set_blocking(self._write, True)
        while data:
            data = data[os.write(self._write, data[:65536]) :]
        os.set_blocking(self._write, False)  # a process that does not read must not stop the one that writes

    def greeting(self, limit_s: float | None = None) -> dict[str, Any]:
        """The message that the other end sent before the first turn.

        Raises:
            PeerError: it ended, sent nothing for so long, or sent something other than an object.
        """
        deadline = None if limit_s is None else time.monotonic() + limit_s
        while b"\n" not in self._heard:
            data = self._listen(deadline)
            if data is None:
                raise PeerError(ENDED, "", REMEDY)
            self._heard += data
            if len(self._heard) > MOST_GREETING:
                raise PeerError("the greeting of the process at the other end is too long", "", REMEDY)
        line, _, self._heard = self._heard.partition(b"\n")
        try:
            found = json.loads(line)
        except ValueError:
            found = None
        if not isinstance(found, dict):
            raise PeerError("what the process at the other end sent is no greeting", "", REMEDY)
        return found

    def post(self, turn: int) -> None:
        """End this turn, and wake the other end if it sleeps."""
        words, side = self._words, self._side
        words[TURN[side]] = turn
        if words[SLEEPS[1 - side]]:
            with contextlib.suppress(BrokenPipeError, BlockingIOError):  # noticed when it is waited for
                os.write(self._write, b".")

    def wait(self, turn: int, limit_s: float | None = None) -> None:
        """Wait until the other end has done this turn.

        Raises:
            PeerError: it ended, or took longer than that.
        """
        self._wait(turn, limit_s)
        if self._words[TURN[1 - self._side]] != turn:
            raise PeerError("the process at the other end took a turn that was not its own", "", REMEDY)

    def next(self, turn: int) -> bool:
        """Wait for the other end to do this turn: True once it has, False when it hung up."""
        try:
            self._wait(turn, None)
        except PeerError:
            return False
        return True

    def _wait(self, turn: int, limit_s: float | None) -> None:
        words, there = self._words, TURN[1 - self._side]
        if words[there] >= turn:
            return
        if self._resting:
            self._resting -= 1
        else:
            for _ in range(self._looks):
                if words[there] >= turn:
                    self._pause = 0
                    return
            self._pause = min(MOST_PAUSE, 2 * self._pause + 4)
            self._resting = self._pause
        deadline = None if limit_s is None else time.monotonic() + limit_s
        words[SLEEPS[self._side]] = 1
        try:
            while words[there] < turn:
                if self._listen(deadline) is None and words[there] < turn:
                    raise PeerError(ENDED, "", REMEDY)
        finally:
            words[SLEEPS[self._side]] = 0

    def _listen(self, deadline: float | None) -> bytes | None:
        """Sleep until bytes come, or a nap is over; returns the bytes, or None when no more can come."""
        if deadline is not None and time.monotonic() > deadline:
            raise PeerError("the process at the other end does not answer", "", "look for a loop that never ends")
        if not self._poll.poll(NAP_MS):
            return b""
        try:
            return os.read(self._read, 1 << 16) or None
        except BlockingIOError:
            return b""

    def close(self) -> None:
        """Close the pipes, which the other end notices."""
        for descriptor in (self._read, self._write, self._memory):
            with contextlib.suppress(OSError):
                os.close(descriptor)


def descriptors(text: str | None) -> tuple[int, int, int]:
    """Read the descriptors of one end from a command line."""
    memory, reading, writing = (int(word) for word in (text or "").split(","))
    return memory, reading, writing


def pair() -> tuple[tuple[int, int, int], tuple[int, int, int]]:
    """Descriptors (memory, reading, writing) of the engine's end and of the author's, to be handed to two processes."""
    if hasattr(os, "memfd_create"):
        memory = os.memfd_create("world", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
    else:
        import tempfile

        with tempfile.TemporaryFile() as file:
            memory = os.dup(file.fileno())
    (to_author, from_engine), (to_engine, from_author) = os.pipe(), os.pipe()
    return (memory, to_engine, from_engine), (os.dup(memory), to_author, from_author)


def _processors() -> set[int]:
    try:
        return os.sched_getaffinity(0)
    except AttributeError:
        return set(range(os.cpu_count() or 1))
