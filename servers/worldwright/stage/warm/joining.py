"""Have an engine forked into a sandbox that bubblewrap has made, in the place of one that bubblewrap starts.

Bubblewrap starts a shell that waits to be told an exit status, and ends with it. Until then its namespaces stand, which the forked
process joins, so that whoever started the shell sees of the engine what was always seen: a child of its own that ends as the engine
does, takes the engine with it when it is killed, and is killed when its parent ends.
"""

import json
import os
import socket
import subprocess
import sys
from contextlib import suppress
from dataclasses import dataclass
from types import ModuleType
from typing import Any

from ..sandbox import bubblewrap, seccomp
from ..sandbox.confinement import Confinement
from . import kept_warm, letters

HOLD = ["/bin/sh", "-c", "echo; read s || s=137; exit $s"]
"""Says that the sandbox is made, then ends as it is told; as if killed where nobody is left who would tell it."""
ENGINE = [sys.executable, "-s", "-P", "-m", "worldengine"]


@dataclass(frozen=True)
class Joined:
    """An engine in its sandbox."""

    process: "subprocess.Popen[bytes]"
    """Bubblewrap's; it ends as the engine does."""
    engine: int
    """The engine's process number here."""
    told: bytes
    """How its births are limited."""
    listener: int | None
    """The descriptor that they are asked on."""
    keeper: socket.socket
    """To the engine's parent, which ends it when this is closed, and tells what processor time it took."""

    def spent_s(self) -> float:
        """The engine's processor time, s, once it has ended; 0 where nobody tells."""
        with suppress(OSError, ValueError):
            return float(self.keeper.recv(100))
        return 0.0


def fits(level: ModuleType, call: list[str], popen: dict[str, Any]) -> bool:
    """Whether this is an engine, at the level that can be joined, with one output for all that it says."""
    engine = level is bubblewrap and call[: len(ENGINE)] == ENGINE
    if not engine or popen.keys() != {"stdout", "stderr"}:
        return False
    return popen["stderr"] == subprocess.STDOUT or popen["stderr"] is popen["stdout"] is not subprocess.PIPE


def join(
    words: list[str], confinement: Confinement, births: int, descriptors: tuple[int, ...], output: Any, run: str = ""
) -> Joined | None:
    """Start an engine; None where it must be started cold, and nothing has begun.

    Args:
        words: its command line.
        confinement: what it may see and use.
        births: so many processes its user may have where the kernel cannot ask about them.
        descriptors: descriptors that it inherits besides its output.
        output: what it prints to: a file, or `subprocess.PIPE`.
        run: a Python file that is run in the engine's place (tests of the sandbox).
    """
    found = kept_warm.ask(letters.ENGINE) if kept_warm.starts_alike(confinement.environment) else None
    if found is None:
        return None
    nursery, asked = found
    made: Made | None = None
    listeners: list[int] = []
    with suppress(OSError, ValueError, subprocess.SubprocessError):
        request = {
            "words": words,
            "run": run,
            "births": births,
            "umask": kept_warm.umask(),
            "descriptors": list(descriptors),
            "limits": {name: getattr(confinement, name) for name in ("cpu_s", "file_bytes", "memory_bytes", "token")},
            "out": str(confinement.out),
            "scratch": str(confinement.scratch),
            "environment": confinement.environment,
        }
        made = Made(confinement, output)
        ours, theirs = socket.socketpair()
        with ours, theirs:
            letters.send(asked, request, (made.inside(), made.status, made.output, theirs.fileno(), *descriptors))
            theirs.close()
            if kept_warm.taken(asked):
                engine = int(asked.recv(100))
                told, listeners, _, _ = socket.recv_fds(ours, 64, 1)
                asked.send(letters.GO)
                asked.settimeout(None)
                made.hand_over()
                return Joined(made.process, engine, told, listeners[0] if listeners else None, asked)
    asked.close()
    for number in listeners:
        os.close(number)
    if made is not None:
        made.end()
    kept_warm.give_up(nursery)
    return None


class Made:
    """A sandbox in which nothing runs but a shell that waits, and can start nothing."""

    def __init__(self, confinement: Confinement, output: Any) -> None:
        self._open: set[int] = set()
        try:
            self._make(confinement, output)
        except BaseException:
            self._close()
            raise

    def _make(self, confinement: Confinement, output: Any) -> None:
        denial, write = self._pipe()
        os.write(write, seccomp.denial(births=False))  # smaller than a pipe's buffer
        self._close_one(write)
        waits, self.status = self._pipe()
        """Written to, the shell ends with that number."""
        self._told, says = self._pipe()
        self._facts, info = self._pipe()
        self._printed: int | None = None
        if output == subprocess.PIPE:
            self._printed, self.output = self._pipe()
        else:
            self.output = self._kept(os.dup(output.fileno()))
        words = bubblewrap.command(HOLD, confinement, denial)
        self.process = subprocess.Popen(
            [words[0], "--info-fd", str(info), *words[1:]],
            stdin=waits,
            stdout=says,
            stderr=self.output,
            cwd=confinement.out,
            env=confinement.environment,
            start_new_session=True,
            preexec_fn=bubblewrap.before_exec(confinement),  # noqa: PLW1509 - system calls only, as for a cold start
            pass_fds=(denial, info),
        )
        for number in (denial, waits, says, info):
            self._close_one(number)

    def inside(self) -> int:
        """A descriptor of the process that holds the namespaces, once all of them are made.

        Raises:
            OSError, ValueError: they could not be made.
        """
        if os.read(self._told, 1) != b"\n":
            raise OSError("bubblewrap has made no sandbox")
        holder = self._kept(os.pidfd_open(json.loads(os.read(self._facts, 4096))["child-pid"]))
        if self.process.poll() is not None:  # its number may be another's by now
            raise OSError("the sandbox has ended")
        return holder

    def hand_over(self) -> None:
        """Close what only the engine and its parent need, and read what it prints as of any child."""
        if self._printed is not None:
            self._open.remove(self._printed)
            self.process.stdout = os.fdopen(self._printed, "rb")
        self._close()

    def end(self) -> None:
        """Take it down."""
        self.process.kill()
        self.process.wait()
        self._close()

    def _pipe(self) -> tuple[int, int]:
        read, write = os.pipe()
        return self._kept(read), self._kept(write)

    def _kept(self, number: int) -> int:
        self._open.add(number)
        return number

    def _close_one(self, number: int) -> None:
        self._open.remove(number)
        os.close(number)

    def _close(self) -> None:
        while self._open:
            os.close(self._open.pop())
