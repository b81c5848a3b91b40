"""What a forked process does first, whatever it is to be: it lets go of what is its parent's, and takes on what it is given."""

import ctypes
import os
import signal
import sys
import time
from itertools import pairwise


def alone(*kept: int) -> None:
    """Close every descriptor but standard input, output and error and those that are kept."""
    for low, high in pairwise([2, *sorted(kept), os.sysconf("SC_OPEN_MAX")]):
        os.closerange(low + 1, high)


def become(environment: dict[str, str], folder: str, umask: int) -> None:
    """Take on what a process that is started anew is given, and draw nothing from what its kin draw from."""
    os.environ.clear()
    os.environ.update(environment)
    os.umask(umask)
    os.chdir(folder)
    time.tzset()
    sys.dont_write_bytecode = bool(environment.get("PYTHONDONTWRITEBYTECODE"))
    if "numpy.random" in sys.modules:  # Python's own generator sees to that by itself
        sys.modules["numpy.random"].seed()


def dies_with_parent() -> None:
    """Be killed when the process that forked this one ends."""
    ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
