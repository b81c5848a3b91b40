"""Limit processes and threads: the kernel holds every birth in a job until its supervisor has said yes.

`RLIMIT_NPROC` counts all processes of a user and never binds root; control groups need to be writable. A seccomp
filter with user notification needs neither: `clone` and `fork` wait for an answer, on every level and for every user.
When the supervisor dies, they fail. Source: seccomp_unotify(2).
"""

import errno
import fcntl
import os
import select
import struct
import threading
import time
from collections.abc import Callable
from pathlib import Path

from .syscalls import number

RECEIVE, ANSWER = 0xC0502100, 0xC0182101
CONTINUE = 1
CLONE_THREAD = 0x00010000
SETTLE_S = 0.25
"""An allowed birth may take so long, s, until a count sees it."""


class Births:
    """Answers the questions of one job's filter until no process of the job is left.

    Args:
        listener: the descriptor that the questions come to; owned and closed here.
        count: the job's processes and threads now.
        processes: how many processes may live at once.
        threads: how many threads, in all processes together.
    """

    def __init__(self, listener: int, count: Callable[[], tuple[int, int]], processes: int, threads: int) -> None:
        self.listener, self.count = listener, count
        self.limits = (processes, threads)
        self.seen, self.since = (0, 0), [0, 0]
        self.pending: dict[int, tuple[float, bool]] = {}
        """For each asker: when its birth was allowed, and whether it is a thread; it asks again only after the birth."""
        self.exceeded = ""
        """The limit that was exceeded, after which the job must be stopped."""
        self.thread = threading.Thread(target=self._serve, daemon=True)
        self.thread.start()

    def _serve(self) -> None:
        poll = select.poll()
        poll.register(self.listener, select.POLLIN)
        try:
            while True:
                events = poll.poll()
                if any(event & (select.POLLHUP | select.POLLERR | select.POLLNVAL) for _, event in events):
                    return
                question = bytearray(80)
                try:
                    fcntl.ioctl(self.listener, RECEIVE, question, True)
                except OSError as gone:
                    if gone.errno in (errno.ENOENT, errno.EINTR):  # the asker died meanwhile
                        continue
                    return
                identity, asker, _flags, call = struct.unpack_from("QIIi", question)
                flags = struct.unpack_from("Q", question, 32)[0]
                self._answer(identity, self._may(asker, call == number("clone") and bool(flags & CLONE_THREAD)))
        finally:
            os.close(self.listener)

    def _answer(self, identity: int, yes: bool) -> None:
        answer = struct.pack("QqiI", identity, 0, 0 if yes else -errno.EAGAIN, CONTINUE if yes else 0)
        try:
            fcntl.ioctl(self.listener, ANSWER, answer)
        except OSError:  # the asker died meanwhile
            return

    def _may(self, asker: int, thread: bool) -> bool:
        """Whether one more may be born: what was counted last, and every birth allowed since, stay under the limits."""
        self.pending.pop(asker, None)
        if not self._room(thread):
            now = time.monotonic()
            recent = ((who, birth) for who, birth in self.pending.items() if now - birth[0] < SETTLE_S)
            self.pending = {who: birth for who, birth in recent if _lives(who)}  # a dead asker has no birth pending
            # The last count may have missed a birth allowed just now: rather count it twice than not at all.
            unseen = list(self.pending.values())
            self.seen, self.since = self.count(), [sum(not birth[1] for birth in unseen), len(unseen)]
            if not self._room(thread):
                limit, what = (self.limits[1], "threads") if thread else (self.limits[0], "processes")
                self.exceeded = f"it started more than {limit} {what}"
                return False
        self.pending[asker] = (time.monotonic(), thread)
        self.since[0] += not thread
        self.since[1] += 1
        return True

    def _room(self, thread: bool) -> bool:
        processes, threads = (seen + since for seen, since in zip(self.seen, self.since, strict=True))
        return threads < self.limits[1] and (thread or processes < self.limits[0])


def _lives(task: int) -> bool:
    """Whether a process or thread still exists and is no zombie."""
    try:
        return Path(f"/proc/{task}/stat").read_text().rpartition(")")[2].split()[0] not in "ZX"
    except (OSError, IndexError):
        return False
