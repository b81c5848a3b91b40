"""Work of a run that nobody waits for, in a process of its own: one for a folder, which holds the folder's lock as long as it lives."""

import os
import subprocess
import sys
from pathlib import Path

from . import try_lock

SWITCH, OFF = "WORLDWRIGHT_BESIDE", "0"
"""The variable that keeps a machine from doing anything unasked, and how."""


def allowed() -> bool:
    """Whether anything may go on unasked."""
    return os.environ.get(SWITCH) != OFF


def begin(module: str, run: Path, folder: Path) -> None:
    """Run `python -m module RUN LOCK` beside, unless one for this folder is under way."""
    handle = os.open(folder, os.O_RDONLY | os.O_DIRECTORY | os.O_CLOEXEC)
    try:
        if try_lock.taken(handle):
            subprocess.Popen(
                [sys.executable, "-P", "-m", module, str(run), str(handle)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
                pass_fds=(handle,),
            )
    finally:  # the process holds the lock by its own copy, and as long as it lives
        os.close(handle)
