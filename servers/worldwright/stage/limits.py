"""The limits of a running job, and a name for every way to fail.

Some limits are the kernel's (file size, births, processor time of one process), some are watched here, because the
kernel has none for a family of processes without control groups: memory, processor time and disk of all together.
Each has its own code, and says what to do.
"""

import os
import shutil
import signal
import time
from pathlib import Path
from typing import Any

from . import family
from .job import Job, Spec
from .sandbox.births import Births
from .sandbox.confinement import Confinement

MB = 1 << 20
SPARE_MEMORY_BYTES = 256 * MB
"""The machine itself keeps this much."""
SPARE_DISK_BYTES = 64 * MB
MOST_FILES = 50_000
DISK_EVERY_S = 0.5
CPU_SIGNAL, SIZE_SIGNAL, KILL_SIGNAL = 24, 25, 9


class Guard:
    """Looks at one job's processes and says which limit they exceed."""

    def __init__(self, spec: Spec, job: Job, confinement: Confinement) -> None:
        self.spec, self.job, self.confinement = spec, job, confinement
        self.births: list[Births] = []
        """One for each of the job's processes whose births are asked for."""
        self.seen: family.Census | None = None
        """The job's processes at the last look."""
        self.cpu_s = 0.0
        self.measured_disk = 0.0

    def look(self, printed: int) -> dict[str, str] | None:
        """The limit that is exceeded now, as code, message and next move; None while there is none."""
        spec = self.spec
        if printed > spec.output_mb * MB:
            return {
                "code": "too_much_output",
                "message": f"it printed more than {spec.output_mb} MB",
                "next_move": "take the prints out of the loop: the recording holds every number",
            }
        now = self.seen = family.census(os.getpid(), itself=False)
        asked = next((births.exceeded for births in self.births if births.exceeded), "")
        if excess := asked if self.births else self._excess(now):
            return {
                "code": "too_many_processes",
                "message": excess,
                "next_move": "start fewer at a time: one a core is the most that helps",
            }
        return self._memory(now) or self._cpu(now) or self._disk()

    def _excess(self, now: family.Census) -> str:
        if len(now.processes) > self.confinement.processes:
            return f"it started more than {self.confinement.processes} processes"
        return f"it started more than {self.confinement.threads} threads" * (now.threads > self.confinement.threads)

    def _memory(self, now: family.Census) -> dict[str, str] | None:
        limit = self.spec.memory_mb * MB
        used = now.resident_bytes
        if used > limit and len(now.processes) > 1:
            used = family.proportional_bytes(now.processes)
        advice = "hold less in memory, or give it more with --memory-mb"
        if used > limit:
            message = f"it used {used / MB:.0f} MB, over its limit of {self.spec.memory_mb} MB"
            return {"code": "out_of_memory", "message": message, "next_move": advice}
        free = family.available_bytes()
        if free is not None and free < SPARE_MEMORY_BYTES and used > SPARE_MEMORY_BYTES:
            message = f"this machine ran out of memory while it used {used / MB:.0f} MB"
            return {"code": "out_of_memory", "message": message, "next_move": "free some memory, then start it again"}
        return None

    def _cpu(self, now: family.Census) -> dict[str, str] | None:
        self.cpu_s = max(self.cpu_s, now.cpu_s)
        if self.spec.cpu_s is None or self.cpu_s <= self.spec.cpu_s:
            return None
        return _out_of_cpu_time(f"it used more than {self.spec.cpu_s:g} s of processor time")

    def _disk(self) -> dict[str, str] | None:
        if time.monotonic() - self.measured_disk < DISK_EVERY_S:
            return None
        self.measured_disk = time.monotonic()
        written, files = 0, 0
        for root in (self.job.out, self.job.author, self.job.scratch):
            for folder, _, names in os.walk(root):
                for name in names:
                    try:
                        written += os.lstat(f"{folder}/{name}").st_blocks * 512
                    except OSError:
                        continue
                files += len(names) + 1
                if files > MOST_FILES or written > self.spec.disk_mb * MB:
                    break
        if files > MOST_FILES or written > self.spec.disk_mb * MB:
            much = f"{self.spec.disk_mb} MB" if files <= MOST_FILES else f"{MOST_FILES} files"
            return {
                "code": "disk_full",
                "message": f"it wrote more than its {much}",
                "next_move": "write less, or give it more room with --disk-mb",
            }
        if shutil.disk_usage(self.job.folder).free < SPARE_DISK_BYTES:
            return {
                "code": "disk_full",
                "message": f"the disk is full after it wrote {written / MB:.0f} MB",
                "next_move": "free some space there, then start it again",
            }
        return None


def failed(status: int, summary: dict[str, Any], error: dict[str, Any], log: str) -> dict[str, str] | None:
    """How a program that ended by itself failed; None when it did not.

    Args:
        status: its exit status, negative for a signal.
        summary: its `result.json`, or empty.
        error: its `error.json`, or empty.
        log: the command that shows its log.
    """
    if status == 0 and summary.get("ok"):
        return None
    if error:
        return _authors_error(error, log)
    number = -status if status < 0 else status - 128 if status > 128 else 0
    if number == CPU_SIGNAL:
        return _out_of_cpu_time("one of its processes used all its processor time")
    if number == SIZE_SIGNAL:
        return _file_too_large("it wrote a file over its limit")
    if number == KILL_SIGNAL:
        cause = "it was killed by a signal (SIGKILL): by itself, or because the machine ran out of memory"
        return {"code": "killed", "message": cause, "next_move": f"see its last words in `{log}`"}
    if number:  # a crash in native code, or an abort: of the program's own doing, unlike a kill
        named = f"{number} ({signal.Signals(number).name})" if number in set(signal.Signals) else f"{number}"
        cause = f"it was ended by signal {named}"
        return {"code": "crashed", "message": cause, "next_move": f"see its last words in `{log}`"}
    if status == 0:
        cause = "it ended without a result: does it hand its world to worldkit's program.main?"
        return {"code": "no_result", "message": cause, "next_move": "end the file with program.main(build, …)"}
    return {"code": "crashed", "message": f"it ended with status {status}", "next_move": f"read `{log}`"}


def _authors_error(error: dict[str, Any], log: str) -> dict[str, str]:
    """The program's own account of its end, which names the limits that it ran into."""
    kind, line, message = str(error.get("type", "error")), error.get("line"), str(error.get("message", ""))
    named = str(error.get("place") or "")  # the engine never saw the program, but may know which file told it so
    file = Path(str(error.get("file") or (named if named.endswith(".py") else "simulation.py"))).name
    place = f"{file}:{line}" if line else file
    if "[Errno 27]" in message:
        return {**_file_too_large(message[:2000]), "place": place}
    if "[Errno 28]" in message:
        advice = "free some space there, then start it again"
        return {"code": "disk_full", "message": message[:2000], "place": place, "next_move": advice}
    code = "out_of_memory" if kind == "MemoryError" else str(error.get("code") or "crashed")
    return {
        "code": code,
        "message": f"{kind}: {message}"[:2000],
        "place": place,
        "next_move": str(error.get("next_move") or f"correct it there; the traceback is in `{log}`"),
    }


def _out_of_cpu_time(message: str) -> dict[str, str]:
    advice = "look for a loop that never ends, or give it more time with --cpu-s"
    return {"code": "out_of_cpu_time", "message": message, "next_move": advice}


def _file_too_large(message: str) -> dict[str, str]:
    return {"code": "file_too_large", "message": message, "next_move": "write less, or raise --file-mb"}
