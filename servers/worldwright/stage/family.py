"""A process and everything it started: resident memory, count, and the end of them all. Source: proc(5)."""

import contextlib
import os
import signal
from pathlib import Path

PAGE = os.sysconf("SC_PAGE_SIZE")


def members(root: int) -> list[int]:
    """The process and all its descendants, found through /proc."""
    children: dict[int, list[int]] = {}
    for entry in Path("/proc").iterdir():
        if entry.name.isdigit():
            try:
                # The command's name stands in parentheses and may hold anything; the parent comes second after it.
                parent = int((entry / "stat").read_text().rpartition(")")[2].split()[1])
            except (OSError, ValueError, IndexError):
                continue
            children.setdefault(parent, []).append(int(entry.name))
    found, queue = [], [root]
    while queue:
        process = queue.pop()
        found.append(process)
        queue += children.get(process, [])
    return found


def resident_bytes(processes: list[int]) -> int:
    """Resident memory of them all, counting shared pages once for each."""
    total = 0
    for process in processes:
        with contextlib.suppress(OSError, ValueError, IndexError):
            total += int(Path(f"/proc/{process}/statm").read_text().split()[1]) * PAGE
    return total


def end(root: int) -> None:
    """Kill the process, its group and every descendant."""
    everyone = members(root)
    with contextlib.suppress(OSError):
        os.killpg(root, signal.SIGKILL)
    for process in everyone:
        with contextlib.suppress(OSError):
            os.kill(process, signal.SIGKILL)
