"""The parent of a headless harness, which ends with whoever asked for it and takes along all that the harness started.

    python -P -m worldwright.campaign.author_watch SESSION PROGRAM WORDS...

A worker that is killed ends nothing any more. So between it and the harness stands this process, whose standard input is a pipe
that nobody writes to: when that closes, by the worker's will or its death, the harness is ended with its descendants and its passes.
What its harness left in a session of its own is handed to it (`PR_SET_CHILD_SUBREAPER`), so that it ends too, also where the harness
ended by itself. It ends as the harness did: with its status, or with 128 and the number of the signal.
"""

import contextlib
import ctypes
import os
import select
import signal
import subprocess
import sys
import time
from pathlib import Path

from worldkit.files import write_atomic

from ..model.errors import WorldwrightError
from ..model.evidence.run import Run
from ..stage import family

PROCESS = "process"
"""In the session's folder: the harness, and when it began; not there where none could be started."""
SUBREAPER = 36
"""Of prctl(2): orphans below us become our children, and not those of the machine's first process."""
LOOK_S, ENDS_S = 0.25, 10.0
"""How often the pipe is looked at; how long a harness has between the polite word and the last."""


def main(session: Path, words: list[str]) -> int:
    """Start a harness, and wait for its end or for that of whoever holds our standard input."""
    with contextlib.suppress(OSError, AttributeError):  # a kernel without it: then as far as its descendants are known
        ctypes.CDLL(None).prctl(SUBREAPER, 1, 0, 0, 0)
    try:
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, start_new_session=True)
    except (OSError, ValueError) as error:
        sys.stderr.write(f"{words[0]}: {error}\n")
        return 127
    try:
        write_atomic(session / PROCESS, f"{process.pid} {since(process.pid)}")
        while not family.ends_within(process, LOOK_S):
            if select.select([sys.stdin], [], [], 0)[0]:
                break
    except OSError as error:  # nobody could end it after us, so it does not begin
        sys.stderr.write(f"what it runs as cannot be noted: {error}\n")
        return 127
    finally:
        end(process.pid)
        stop_passes(session)
        end_below()
    code = process.wait()
    return code if code >= 0 else 128 - code


def stop(session: Path) -> bool:
    """End what a session left behind, with all that it started; whether it lived."""
    lived = False
    with contextlib.suppress(OSError, ValueError):  # it was never started
        pid, began = (session / PROCESS).read_text().split()
        if lived := since(int(pid)) == began:
            end(int(pid))
    stop_passes(session)  # they outlive their harness, however that ended
    return lived


def end(pid: int) -> None:
    """End a process and all that descends from it: first politely, since a harness then ends its servers."""
    processes = family.census(pid).processes
    for sent in (signal.SIGTERM, signal.SIGKILL):
        with contextlib.suppress(OSError):
            os.killpg(pid, sent)
        ends = time.monotonic() + ENDS_S
        while sent == signal.SIGTERM and any(map(since, processes)) and time.monotonic() < ends:
            time.sleep(0.02)
    for process in processes:
        with contextlib.suppress(OSError):
            os.kill(process, signal.SIGKILL)


def end_below() -> None:
    """End what is left below this process: what the harness started in a session of its own."""
    for _ in range(100):  # whose parent is killed becomes ours a moment later
        if not (left := family.census(os.getpid(), itself=False).processes):
            return
        for process in left:
            with contextlib.suppress(OSError):
                os.kill(process, signal.SIGKILL)
        time.sleep(0.01)


def stop_passes(session: Path) -> None:
    """End the passes that run in the author's project, which are no descendants of its harness any more."""
    for folder in (session / "project/runs").glob("*/"):
        end_passes(Run(folder))


def end_passes(run: Run) -> None:
    """End the passes of one run; a folder of jobs that cannot be read, or is a link, holds none of it."""
    from ..stage.job import Job

    with contextlib.suppress(WorldwrightError, OSError):
        for job in Job.all(run):
            with contextlib.suppress(WorldwrightError, OSError):
                job.cancel()


def since(pid: int) -> str:
    """When a living process began, in the kernel's ticks, which tells it from a later one of its number; empty: it does not live."""
    try:
        words = Path(f"/proc/{pid}/stat").read_text(errors="replace").rpartition(")")[2].split()
    except OSError:
        return ""
    return "" if words[0] in "ZX" else words[19]


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2:]))
