"""The seconds that something had for itself, on a machine where other work runs: what tells that it stands still, not that it waits."""

import os
from pathlib import Path

STARVED = 20.0
"""What gets less than this part of its time is ended all the same."""


class OwnTime:
    """The seconds that a run had for itself: all in which it slept, and of the others those that it computed."""

    def __init__(self, now_s: float) -> None:
        self.spent_s, self._now, self._cpu, self._began = 0.0, now_s, 0.0, now_s

    def after(self, now_s: float, cpu_s: float, wanting: bool) -> float:
        """The seconds until now.

        Args:
            now_s: of a clock that never goes back.
            cpu_s: processor time of all its processes so far.
            wanting: whether one of them computes or would like to; several at once count as one.
        """
        passed, computed = now_s - self._now, max(cpu_s - self._cpu, 0.0)
        self.spent_s += min(passed, computed) if wanting else passed
        self._now, self._cpu = now_s, cpu_s
        return max(self.spent_s, (now_s - self._began) / STARVED)


def of_process(pid: int) -> tuple[float, bool]:
    """Processor time of one process so far, s, and whether it computes or waits for the processor or a disk; where the system
    does not tell (proc(5)), as of one that sleeps."""
    try:
        words = Path(f"/proc/{pid}/stat").read_bytes().rpartition(b")")[2].split()
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK"), words[0] in (b"R", b"D")
    except (OSError, IndexError, ValueError):
        return 0.0, False
