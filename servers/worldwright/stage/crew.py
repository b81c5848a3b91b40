"""The confined processes of one job: the author's and the engine's, with one log, one watch and one end.

Each has a sandbox of its own: the author's process sees the program and writes a folder that is thrown away, the engine's
sees the built world and writes what becomes evidence. Neither sees the other's.
"""

import contextlib
import math
import os
import subprocess
import threading
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ..model.own_time import OwnTime
from . import compiled_shaders, family, sandbox
from .job import Job
from .kept_sculpts import Given
from .limits import Guard
from .sandbox.confinement import Confinement, environment
from .sandbox.enter import Entered, enter

LOG_BYTES = 1_000_000
TICK_S, REAPED_S = 0.1, 2.0
ADDRESS_SPACE_SLACK = 12 << 30
"""Software OpenGL and its compiler reserve far more address space than they use; resident memory is the real limit."""
UNLIMITED_CPU_S = 30 * 86_400
"""The kernel wants a number here; a job that no longer advances is ended by the clock."""
UNDRAWN = ("bundle", "physics")
"""Passes that draw nothing."""
MB = 1 << 20


@dataclass(frozen=True)
class Member:
    """One confined process."""

    process: "subprocess.Popen[bytes]"
    out: Path
    """The one folder that it may write."""
    reader: threading.Thread
    """The thread that copies its output into the log."""
    entered: Entered
    """How it was started; held here, since a forked engine ends when the socket to its keeper is dropped."""


class Crew:
    """Starts the processes of a job, watches them, and ends them."""

    def __init__(self, job: Job, level: str) -> None:
        self.job, self.spec, self.level = job, job.spec, level
        self.facts: dict[str, str] = {}
        """The means that enforce the limits, for the evidence."""
        self.printed = 0
        self.members: list[Member] = []
        self._sculpts: list[tuple[Given, Path]] = []
        self._drew: Path | None = None
        """The home of an engine that draws."""
        self._log = job.log.open("wb")
        self._lock = threading.Lock()
        self._guard: Guard | None = None
        self._started = time.monotonic()

    def start(
        self,
        name: str,
        call: Sequence[str],
        out: Path,
        reads: Sequence[Path],
        descriptors: Sequence[int] = (),
        sculpts: Given | None = None,
    ) -> Member:
        """Start a process that may read `reads`, write `out`, inherits `descriptors`, and is given kept shapes."""
        scratch = self.job.scratch / name
        for folder in (out, scratch):
            folder.mkdir(parents=True, exist_ok=True)
        if name == "engine" and self.spec.stage not in UNDRAWN:
            compiled_shaders.lay(scratch, Path(self.spec.run))
            self._drew = scratch
        confinement = Confinement(
            out=out,
            reads=(*reads, *(path for path in (sculpts.places if sculpts else ()) if path.is_dir())),
            scratch=scratch,
            cpu_s=math.ceil(self.spec.cpu_s or UNLIMITED_CPU_S),
            file_bytes=self.spec.file_mb * MB,
            memory_bytes=self.spec.memory_mb * MB + ADDRESS_SPACE_SLACK,
            token=self.spec.token,
            environment=environment(str(scratch), str(self.job.lock)) | (sculpts.variables(scratch) if sculpts else {}),
        )
        rung = sandbox.LADDER[self.level]
        pipes: dict[str, Any] = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}
        entered = enter(rung, list(call), confinement, root=os.getpid(), descriptors=tuple(descriptors), **pipes)
        self.facts = entered.facts
        reader = threading.Thread(target=self._keep_log, args=(entered.process.stdout,), daemon=True)
        reader.start()
        member = Member(entered.process, out, reader, entered)
        self.members.append(member)
        if sculpts is not None:
            self._sculpts.append((sculpts, scratch))
        if self._guard is None:
            self._guard = Guard(self.spec, self.job, confinement)
        if entered.births is not None:
            self._guard.births.append(entered.births)
        return member

    def watch(self, member: Member, tick: Callable[[float], bool]) -> dict[str, str] | None:
        """Wait until a process ends; returns why the job was stopped, if a limit or a person stopped it.

        `tick` takes the job's time so far, s, and returns whether the job has advanced since the last call. How long it stands still is
        told by its own time (`model.own_time`): what other work beside it takes of the processor does not count.
        """
        own, advanced = OwnTime(time.monotonic()), 0.0
        while not family.ends_within(member.process, TICK_S):
            reap_orphans([one.process for one in self.members])
            if self.cancelled():
                return self.job.asked_to_end()
            if stopped := self.look():
                return stopped
            seen = self._guard.seen if self._guard else None
            now = own.after(time.monotonic(), seen.cpu_s if seen else 0.0, bool(seen and seen.wanting))
            if tick(self.elapsed()):
                advanced = now
            if now - advanced > self.spec.still_s:
                return {
                    "code": "timed_out",
                    "message": f"nothing advanced for {self.spec.still_s:g} s",
                    "next_move": "look for a loop that never ends, or let it stand still for longer with --still-s",
                }
        return None

    def cancelled(self) -> bool:
        """Whether a person has asked for the job's end."""
        return (self.job.folder / "cancel").exists()

    def elapsed(self) -> float:
        """The job's time so far, s."""
        return time.monotonic() - self._started

    def look(self) -> dict[str, str] | None:
        """The limit that is exceeded now; None while there is none."""
        return self._guard.look(self.printed) if self._guard else None

    def end(self) -> None:
        """End every process of the job, and keep the end of its output."""
        for member in self.members:
            family.end(member.process.pid, 0)
        family.sweep(self.spec.token)
        for member in self.members:
            member.process.wait()
            member.reader.join(timeout=5)
        if self._drew is not None and all(member.process.returncode == 0 for member in self.members):
            compiled_shaders.keep(self._drew, Path(self.spec.run))
        self.members, self._drew = [], None
        for sculpts, scratch in self._sculpts:
            sculpts.keep(scratch)
        self._sculpts = []

    def _keep_log(self, stream: Any) -> None:
        """Copy output into the log up to a cap; beyond it, count and discard."""
        while chunk := stream.read1(65536):
            with self._lock:
                room = LOG_BYTES - self.printed
                self.printed += len(chunk)
                if room > 0:
                    self._log.write(chunk[:room])
                    if len(chunk) > room:
                        self._log.write(b"\n[the log is cut here: its limit is 1 MB]\n")
                    self._log.flush()


def adopt_orphans() -> None:
    """Become the parent of the processes that a program leaves behind, so that they are counted and ended, too."""
    import ctypes

    ctypes.CDLL(None).prctl(36, 1, 0, 0, 0)  # PR_SET_CHILD_SUBREAPER


def reap_all(seconds: float = REAPED_S) -> None:
    """Wait for all that is left after the members' end: the kernel counts a process's time for its parent when it is reaped.

    bubblewrap leaves its child, under which the program ran, to whoever adopts it.
    """
    until = time.monotonic() + seconds
    with contextlib.suppress(ChildProcessError):
        while time.monotonic() < until:
            if os.waitpid(-1, os.WNOHANG)[0] == 0:
                time.sleep(TICK_S / 10)


def reap_orphans(members: "Sequence[subprocess.Popen[bytes]]") -> None:
    """Reap adopted processes that have ended; the members' own handles reap the members."""
    ours = [member.pid for member in members if member.poll() is None]
    with contextlib.suppress(OSError):
        while (ended := os.waitid(os.P_ALL, 0, os.WEXITED | os.WNOHANG | os.WNOWAIT)) and ended.si_pid not in ours:
            os.waitpid(ended.si_pid, 0)
