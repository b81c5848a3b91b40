"""Handing a built world to the process that owns worlds while they run, and answering its questions.

A program run by hand does here what the suite's supervisor does for a confined one: it writes its world as one file, starts
`python -m worldengine` on it, and answers for its own `control` until that process hangs up.
"""

import os
import subprocess
import sys
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from . import channel

if TYPE_CHECKING:
    from .laws import Law
    from .speaking import Control


def run(words: Sequence[str]) -> int:
    """Run the engine's process to its end; returns its exit status."""
    return subprocess.run(_call(words), env=_environment(), check=False).returncode


def converse(
    words: Sequence[str], control: "Control | None", stray: Callable[[str, bool], object], laws: "Sequence[Law]" = ()
) -> int:
    """Run the engine's process and answer its questions; returns its exit status.

    What `control` or a law raises is raised here.
    """
    from .speaking import serve

    theirs, ours = channel.pair()
    call = [*_call(words), "--channel", ",".join(map(str, theirs))]
    process = subprocess.Popen(call, env=_environment(), pass_fds=theirs)
    for descriptor in theirs:
        os.close(descriptor)
    end = channel.Channel(ours, channel.AUTHOR)
    try:
        serve(control, end, stray, laws)
    finally:
        end.close()  # the engine notices, keeps what is recorded and ends
        process.wait()
    return process.returncode


def _call(words: Sequence[str]) -> list[str]:
    return [sys.executable, "-s", "-P", "-m", "worldengine", *words]


def _environment() -> dict[str, str]:
    """This process's environment, with the folder of both packages first on the path."""
    place = str(Path(__file__).parents[1])
    known = os.environ.get("PYTHONPATH")
    return {**os.environ, "PYTHONPATH": os.pathsep.join([place, known] if known else [place])}
