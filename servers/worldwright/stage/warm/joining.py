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
    asked = kept_warm.ask(letters.ENGINE) if kept_warm.starts_alike(confinement.environment) else None
    if asked is None:
        return None
    made = Made(confinement, output)
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
    ours, theirs = socket.socketpair()
    with ours, theirs, suppress(OSError, ValueError):
        given = (made.inside(), made.status, made.output, theirs.fileno(), *descriptors)
        letters.send(asked, request, given)
        theirs.close()
        if kept_warm.taken(asked):
            engine = int(asked.recv(100))
            told, listeners, _, _ = socket.recv_fds(ours, 64, 1)
            asked.send(letters.GO)
            asked.settimeout(None)
            made.hand_over()
            return Joined(made.process, engine, told, listeners[0] if listeners else None, asked)
    asked.close()
    made.end()
    kept_warm.give_up()
    return None


class Made:
    """A sandbox in which nothing runs but a shell that waits."""

    def __init__(self, confinement: Confinement, output: Any) -> None:
        denial, write = os.pipe()
        os.write(write, seccomp.denial())  # smaller than a pipe's buffer
        os.close(write)
        waits, self.status = os.pipe()
        """Written to, the shell ends with that number."""
        self._told, says = os.pipe()
        self._facts, info = os.pipe()
        piped: tuple[int | None, int] = os.pipe() if output == subprocess.PIPE else (None, os.dup(output.fileno()))
        self._printed, self.output = piped
        self._inside: int | None = None
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
            os.close(number)

    def inside(self) -> int:
        """A descriptor of the process that holds the namespaces, once all of them are made.

        Raises:
            OSError, ValueError: they could not be made.
        """
        if os.read(self._told, 1) != b"\n":
            raise OSError("bubblewrap has made no sandbox")
        holder = json.loads(os.read(self._facts, 4096))["child-pid"]
        self._inside = os.pidfd_open(holder)
        if self.process.poll() is not None:  # its number may be another's by now
            raise OSError("the sandbox has ended")
        return self._inside

    def hand_over(self) -> None:
        """Close what only the engine and its parent need, and read what it prints as of any child."""
        self._close(self.status, self.output, self._told, self._facts, self._inside)
        if self._printed is not None:
            self.process.stdout = os.fdopen(self._printed, "rb")

    def end(self) -> None:
        """Take it down."""
        self.process.kill()
        self.process.wait()
        self._close(self.status, self.output, self._told, self._facts, self._inside, self._printed)

    def _close(self, *numbers: int | None) -> None:
        for number in numbers:
            if number is not None:
                os.close(number)
