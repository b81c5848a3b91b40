"""The process of a pre-roll, forked from a test's own instead of started anew.

It is a process of its own all the same, asked by the same file, followed and ended as any, and nothing that it does reaches the test's.
But Python and the simulator are not loaded again for each of hundreds of questions that are answered in less time than that.
"""

import os
import subprocess
import sys
import traceback
from collections.abc import Mapping, Sequence
from types import SimpleNamespace
from typing import IO

from worldwright.place import asking


class Forked:
    """Stands for the `subprocess.Popen` of `python … -m worldwright.place.preroll`."""

    returncode: int | None = None

    def __init__(
        self, _: Sequence[str], *, stdin: IO[bytes], stdout: int, stderr: IO[bytes], cwd: str, env: Mapping[str, str]
    ) -> None:
        from worldkit import assets, beside_program, bodies, contacts, models  # noqa: F401 - loaded once, here
        from worldwright.place import grounds, preroll, visibility  # noqa: F401

        for stream in (sys.stdout, sys.stderr):
            stream.flush()  # else what waits there would be written twice
        self.pid = os.fork()
        if self.pid:
            return
        status = 1
        try:
            for number, given in enumerate((stdin.fileno(), os.open(os.devnull, os.O_WRONLY), stderr.fileno())):
                os.dup2(given, number)
            os.closerange(3, os.sysconf("SC_OPEN_MAX"))
            sys.stdin, sys.stdout, sys.stderr = open(0), open(1, "w"), open(2, "w")  # noqa: SIM115 - to the end
            os.environ.clear()
            os.environ.update(env)
            os.chdir(cwd)
            preroll.main()
            status = 0
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stderr.flush()
            os._exit(status)

    def kill(self) -> None:
        """End it."""
        os.kill(self.pid, 9)


STARTED = asking.subprocess
"""What starts it otherwise."""


def fork() -> None:
    """From now on this process forks its pre-rolls."""
    asking.subprocess = SimpleNamespace(Popen=Forked, DEVNULL=subprocess.DEVNULL)
