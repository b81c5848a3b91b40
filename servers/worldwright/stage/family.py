"""Count, measure and end a process with everything that it started.

Descendants are found by parentage, and for the last count by the token that every process of a job carries as a
resource limit: one that was orphaned on purpose, or whose supervisor was killed, still carries it. Source: proc(5).
"""

import contextlib
import os
import secrets
import select
import signal
import subprocess
import time
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

PAGE = os.sysconf("SC_PAGE_SIZE")
TICKS = os.sysconf("SC_CLK_TCK")


@dataclass(frozen=True)
class Census:
    """A family at one moment."""

    processes: tuple[int, ...]
    threads: int
    cpu_s: float
    """Processor time of the living and of the children that they waited for, s."""
    resident_bytes: int
    """Resident memory; pages that processes share count once for each."""
    wanting: bool
    """Whether some process computes, or waits for the processor or a disk; else all of them sleep."""


UNCOUNTED: set[int] = set()
"""Processes of ours in a family that only have others started (`warm`): neither they nor their children count, but theirs."""


def census(root: int, *more: int, itself: bool = True) -> Census:
    """The process and all its living descendants, found through /proc; with `more`, those of other processes, too."""
    started = _children if os.path.exists(f"/proc/{root}/task/{root}/children") else _by_parent()  # noqa: PTH110 - many a second
    facts: dict[int, tuple[int, float, int, bool]] = {}
    queue, seen = [(0, one) for one in (root, *more)], set[int]()
    while queue:
        parent, pid = queue.pop()
        if pid in seen:
            continue
        seen.add(pid)
        queue += [(pid, child) for child in started(pid)]
        if pid in UNCOUNTED or parent in UNCOUNTED:
            continue
        if words := _stat(pid):
            spent = sum(int(word) for word in words[11:15]) / TICKS
            zombie = words[0] == b"Z"
            facts[pid] = (0 if zombie else int(words[17]), spent, int(words[21]) * PAGE, words[0] in (b"R", b"D"))
    living = [p for p in facts if facts[p][0] and (itself or p != root)]
    return Census(
        processes=tuple(living),
        threads=sum(facts[p][0] for p in living),
        cpu_s=sum(facts[p][1] for p in living),
        resident_bytes=sum(facts[p][2] for p in living),
        wanting=any(facts[p][3] for p in living),
    )


def _spent_s(pid: int) -> float:
    """Processor time of a process, which may have ended, and of those that it has waited for, s."""
    words = _stat(pid)
    return sum(int(word) for word in words[11:15]) / TICKS if words else 0.0


def _stat(pid: int) -> list[bytes]:
    """What the kernel tells of a process, from its state on; nothing when it is gone.

    The command's name stands in parentheses and may hold anything; the state comes after it.
    """
    return _read(f"/proc/{pid}/stat").rpartition(b")")[2].split()


def _read(path: str) -> bytes:
    try:
        with open(path, "rb", buffering=0) as file:  # noqa: PTH123 - it is asked many times a second
            return file.read()
    except OSError:
        return b""


def _children(pid: int) -> list[int]:
    """The processes that one has started, by each of its threads, as the kernel lists them."""
    try:
        threads = os.listdir(f"/proc/{pid}/task")  # noqa: PTH208
    except OSError:
        return []
    return [int(word) for thread in threads for word in _read(f"/proc/{pid}/task/{thread}/children").split()]


def _by_parent() -> Callable[[int], list[int]]:
    """The same from what all processes tell of their parents, on a kernel that lists no children."""
    children: dict[int, list[int]] = {}
    for name in os.listdir("/proc"):  # noqa: PTH208
        if name.isdigit() and (words := _stat(int(name))):
            children.setdefault(int(words[1]), []).append(int(name))
    return lambda pid: children.get(pid, [])


def proportional_bytes(processes: tuple[int, ...]) -> int:
    """Memory of all processes, with a shared page counted once; resident memory where the kernel does not tell."""
    total = 0
    for process in processes:
        with contextlib.suppress(OSError, ValueError, IndexError):
            try:
                rollup = Path(f"/proc/{process}/smaps_rollup").read_text()
                total += next(int(line.split()[1]) for line in rollup.splitlines() if line.startswith("Pss:")) << 10
            except (OSError, StopIteration):
                total += int(Path(f"/proc/{process}/statm").read_text().split()[1]) * PAGE
    return total


def available_bytes() -> int | None:
    """The memory that the machine can still give; None where it does not tell."""
    try:
        for line in Path("/proc/meminfo").read_text().splitlines():
            if line.startswith("MemAvailable:"):
                return int(line.split()[1]) << 10
    except (OSError, ValueError):
        pass
    return None


def ends_within(
    process: "subprocess.Popen[bytes]", seconds: float, at_end: Callable[[float], object] = lambda _: None
) -> bool:
    """Whether a child ends within so many seconds, told at the moment that it does; a kernel that does not tell is asked.

    `at_end` is told the processor time of the child and of those that it has waited for, s, where that is known.
    """
    if process.returncode is not None:
        return True
    try:
        told = os.pidfd_open(process.pid)
    except (OSError, AttributeError):
        until = time.monotonic() + seconds
        while process.poll() is None and time.monotonic() < until:
            time.sleep(0.01)
        return process.poll() is not None
    try:
        ended = select.poll()
        ended.register(told, select.POLLIN)
        if ended.poll(1000 * seconds):
            at_end(_spent_s(process.pid))  # until it is waited for the kernel knows it
    finally:
        os.close(told)
    return process.poll() is not None


def new_token() -> int:
    """A token of 36 random bits; never zero."""
    return secrets.randbits(36) | 1


def mark(token: int) -> tuple[int, int]:
    """The token as soft and hard limit of message-queue bytes: below what any user may set, and used by nothing else."""
    return token >> 18, (1 << 19) + (token & 0x3FFFF)


def bearing(token: int) -> list[int]:
    """Every living process that carries a job's token."""
    found = []
    wanted = [str(part).encode() for part in mark(token)]
    for name in os.listdir("/proc"):  # noqa: PTH208
        if name.isdigit():
            line = _read(f"/proc/{name}/limits").partition(b"Max msgqueue size")[2].split(b"\n", 1)[0]
            if line.split()[:2] == wanted and _stat(int(name))[:1] not in ([], [b"Z"], [b"X"]):
                found.append(int(name))
    return found


def end(root: int, token: int) -> None:
    """Kill a job's processes until none is left: one may be born between the look and the kill."""
    with contextlib.suppress(OSError):
        os.killpg(root, signal.SIGKILL)
    sweep(token)


def sweep(token: int) -> None:
    """Kill every process that carries the token; no process carries zero."""
    for _ in range(20 if token else 0):
        processes = [p for p in bearing(token) if p != os.getpid()]
        if not processes:
            return
        for process in processes:
            with contextlib.suppress(OSError):
                os.kill(process, signal.SIGKILL)
        time.sleep(0.01)
