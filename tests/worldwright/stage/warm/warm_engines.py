"""Programs of the tests in the place of an engine that is forked into its sandbox, and the same started cold."""

import os
import select
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from unittest import mock

from worldwright.stage import family, sandbox
from worldwright.stage.sandbox.confinement import Confinement, environment
from worldwright.stage.sandbox.enter import Entered, enter, joined_as
from worldwright.stage.warm import joining, kept_warm

BUBBLEWRAP = sandbox.LADDER["bubblewrap"]


@contextmanager
def nursery(since_s: float | None = None) -> Iterator[kept_warm.Nursery]:
    """This process's nursery, which is ready; as if it had loaded its files at `since_s`."""
    now = kept_warm.Nursery.start(since_s)
    before = kept_warm.use(now)
    select.select([now.control], [], [])  # until it is ready
    try:
        with mock.patch.dict(os.environ, {kept_warm.SWITCH: "1"}):
            yield now
    finally:
        kept_warm.use(before)
        now.close()
        now.process.wait()


def confinement(folder: Path, *reads: Path, **limits: int) -> Confinement:
    """What a program may see and use, in folders of its own."""
    for name in ("out", "scratch"):
        (folder / name).mkdir(parents=True)
    given = {"cpu_s": 20, "file_bytes": 1 << 20, "memory_bytes": 16 << 30, "token": family.new_token(), **limits}
    return Confinement(
        out=folder / "out",
        reads=reads,
        scratch=folder / "scratch",
        environment=environment(str(folder / "scratch")),
        **given,
    )


def started(program: Path, given: Confinement, warm: bool, *words: str) -> Entered:
    """The program in its sandbox; what it prints is a pipe."""
    if not warm:
        call = [sys.executable, "-s", "-P", str(program), *words]
        return enter(BUBBLEWRAP, call, given, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    joined = joining.join(list(words), given, 1000, (), subprocess.PIPE, run=str(program))
    assert joined is not None, "it would have been started cold"
    return joined_as(joined, given, 0, BUBBLEWRAP.facts())


def said(program: Path, given: Confinement, warm: bool, *words: str) -> tuple[int, str]:
    """Its exit status and all that it printed, once it has ended."""
    entered = started(program, given, warm, *words)
    with entered.process.stdout as printed:
        text = printed.read().decode()
    status = entered.process.wait()
    family.end(entered.process.pid, given.token)
    return status, text
