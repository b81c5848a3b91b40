"""The engine's process, forked from a test's own instead of started anew.

It is a process of its own all the same: it speaks over the same channel, and nothing that it does reaches the test's. But Python and
the simulator are not loaded again for each of hundreds of simulations that are shorter than that.
"""

import importlib
import os
import sys
import traceback
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from itertools import pairwise
from types import SimpleNamespace
from unittest import mock

from worldengine.__main__ import main
from worldkit import handover


class Forked:
    """Stands for the `subprocess.Popen` of `python … -m worldengine WORDS`."""

    def __init__(self, call: Sequence[str], env: Mapping[str, str] | None = None, pass_fds: Sequence[int] = ()) -> None:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()  # else what waits there would be written twice
        words = list(call)[list(call).index("worldengine") + 1 :]
        self._told, telling = os.pipe()
        self.pid = os.fork()
        if self.pid == 0:
            _work(words, [*pass_fds, telling], telling, env)
        os.close(telling)

    def wait(self) -> int:
        """Wait for its end, and load what it had to load, for the next one; its exit status."""
        with os.fdopen(self._told) as told:
            names = told.read().split()
        self.returncode = os.waitstatus_to_exitcode(os.waitpid(self.pid, 0)[1])
        for name in names:
            importlib.import_module(name)
        return self.returncode


def _run(call: Sequence[str], env: Mapping[str, str] | None = None, **_: object) -> Forked:
    process = Forked(call, env)
    process.wait()
    return process


def _work(words: Sequence[str], kept: Sequence[int], telling: int, env: Mapping[str, str] | None) -> None:
    """Be the engine, and end, in a forked process that holds no file of its parent's but those that it is given."""
    status, known = 1, set(sys.modules)
    try:
        for low, high in pairwise([2, *sorted(kept), os.sysconf("SC_OPEN_MAX")]):
            os.closerange(low + 1, high)
        sys.stdout, sys.stderr = (open(number, "w", closefd=False) for number in (1, 2))  # noqa: SIM115 - to the end
        if env is not None:
            os.environ.clear()
            os.environ.update(env)
        status = _status(words)
        ours = [name for name in sys.modules if name not in known and name.startswith(("worldengine", "worldkit"))]
        os.write(telling, " ".join([*ours, "numpy.ma", "pyarrow"]).encode())
    finally:
        for stream in (sys.stdout, sys.stderr):
            stream.flush()
        os._exit(status)


def _status(words: Sequence[str]) -> int:
    """What the interpreter itself would end with: an exit keeps its code, any other exception is printed."""
    try:
        return main(words)
    except SystemExit as ended:
        if ended.code is not None and not isinstance(ended.code, int):
            print(ended.code, file=sys.stderr)
            return 1
        return ended.code or 0
    except BaseException:
        traceback.print_exc()
        return 1


@contextmanager
def forked_engine() -> Iterator[None]:
    """Within it, programs that are run by hand in this process fork their engine."""
    with mock.patch.object(handover, "subprocess", SimpleNamespace(run=_run, Popen=Forked)):
        yield
