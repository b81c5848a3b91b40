"""Start a program inside a level of the ladder, with the limit on births that works here."""

import contextlib
import os
import socket
import subprocess
import threading
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from types import ModuleType
from typing import Any

from .. import family
from ..warm import joining
from . import seccomp
from .births import Births
from .confinement import Confinement


@dataclass(frozen=True)
class Entered:
    """A running confined program."""

    process: "subprocess.Popen[bytes]"
    births: Births | None
    """Decides on new processes and threads; None where the kernel cannot ask."""
    facts: dict[str, str]
    """The means that enforce the limits, for the evidence."""
    joined: joining.Joined | None = None
    """The engine, where it was forked into the sandbox that `process` made."""

    @property
    def roots(self) -> tuple[int, ...]:
        """The processes whose descendants are the program's."""
        return (self.process.pid, *((self.joined.engine,) if self.joined else ()))

    def spent_s(self, seen_s: float) -> float:
        """Its processor time once it has ended, s, of which `seen_s` was told by the kernel."""
        return max(seen_s, self.joined.spent_s()) if self.joined else seen_s


def enter(
    level: ModuleType,
    call: list[str],
    confinement: Confinement,
    *,
    root: int = 0,
    descriptors: tuple[int, ...] = (),
    **popen: Any,
) -> Entered:
    """Start `call` at one level.

    Args:
        level: a module of the ladder.
        call: the command line.
        confinement: what it may see and use.
        root: the process whose descendants are counted (a supervisor that adopts orphans counts its own); 0 for the program
            itself.
        descriptors: descriptors that it inherits besides its output.
        popen: further arguments of `Popen`, such as how its output is read.
    """
    others = 0 if os.geteuid() == 0 else _processes_of_this_user()
    if joining.fits(level, call, popen):
        words, most, output = call[len(joining.ENGINE) :], others + confinement.processes, popen["stdout"]
        if joined := joining.join(words, confinement, most, descriptors, output):
            return joined_as(joined, confinement, root, level.facts())
    ours, theirs = socket.socketpair()
    read, write = os.pipe()
    os.write(write, seccomp.denial())  # smaller than a pipe's buffer
    os.close(write)
    confine = level.before_exec(confinement)

    def before() -> None:
        limit_births(theirs, others + confinement.processes)
        confine()

    with ours, theirs:
        try:
            process = subprocess.Popen(
                level.command(call, confinement, read),
                stdin=subprocess.DEVNULL,
                cwd=confinement.out,
                env=confinement.environment,
                start_new_session=True,
                preexec_fn=before,  # noqa: PLW1509 - system calls only: it takes no lock that another thread may hold
                pass_fds=(read, *descriptors),
                **popen,
            )
        finally:
            os.close(read)
        word, listeners, _, _ = socket.recv_fds(ours, 64, 1)
    births = None
    if listeners:
        births = Births(
            listeners[0],
            _counter(root or process.pid, itself=not root),
            confinement.processes,
            confinement.threads,
        )
    return Entered(process, births, {"births": word.decode(), **level.facts()})


def joined_as(joined: joining.Joined, confinement: Confinement, root: int, facts: dict[str, str]) -> Entered:
    """What is to be known of an engine that was forked into its sandbox; see `enter`."""
    births = None
    if joined.listener is not None:
        counted = _counter(*((root,) if root else (joined.process.pid, joined.engine)), itself=not root)
        births = Births(joined.listener, counted, confinement.processes, confinement.threads)
    return Entered(joined.process, births, {"births": joined.told.decode(), **facts}, joined)


def limit_births(told: socket.socket, user_limit: int) -> None:
    """Limit births in the child: ask the supervisor, or count the user's processes, or leave it to the watch."""
    try:
        listener = seccomp.install(seccomp.births(), listen=True)
    except OSError:
        if os.geteuid() == 0:  # the count never binds root
            told.send(b"watched")
            return
        import resource

        resource.setrlimit(resource.RLIMIT_NPROC, (user_limit, user_limit))
        told.send(b"counted for the user (RLIMIT_NPROC)")
        return
    socket.send_fds(told, [b"asked for (seccomp notification)"], [listener])
    os.close(listener)


def _counter(*roots: int, itself: bool) -> Callable[[], tuple[int, int]]:
    def count() -> tuple[int, int]:
        now = family.census(*roots, itself=itself)
        return len(now.processes), now.threads

    return count


def _processes_of_this_user() -> int:
    """The number of this user's threads, which RLIMIT_NPROC limits."""
    total = 0
    for entry in Path("/proc").iterdir():
        with contextlib.suppress(OSError, ValueError, IndexError):
            if entry.name.isdigit() and entry.stat().st_uid == os.geteuid():
                total += int((entry / "stat").read_text().rpartition(")")[2].split()[17])
    return total


def run(
    level: ModuleType, call: list[str], confinement: Confinement, timeout_s: float
) -> "subprocess.CompletedProcess":
    """Run a short program to its end and return what it said; killed when it takes too long."""
    entered = enter(level, call, confinement, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    killer = threading.Timer(timeout_s, family.end, (entered.process.pid, confinement.token))
    killer.start()
    try:
        out, errors = entered.process.communicate()
    finally:
        killer.cancel()
        family.end(entered.process.pid, confinement.token)
    return subprocess.CompletedProcess(call, entered.process.returncode, out, errors)
