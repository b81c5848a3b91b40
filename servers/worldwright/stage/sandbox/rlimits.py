"""Resource limits alone: processor time, file size, address space, processes, no core dumps.

The weakest level: it stops accidents, not intent. Also the common floor of the stronger levels. Source: setrlimit(2).
"""

import os
from collections.abc import Callable

from .confinement import Confinement

PR_SET_PDEATHSIG = 1
PR_SET_NO_NEW_PRIVS = 38


def unusable() -> str:
    """Why this level does not work here; empty when it does."""
    return "" if os.name == "posix" else "there are no POSIX resource limits on this system"


def command(call: list[str], confinement: Confinement) -> list[str]:
    """The call as it is."""
    return call


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """What the child does to itself between fork and exec."""
    import ctypes
    import resource
    import signal

    libc = ctypes.CDLL(None, use_errno=True)
    limits = {
        resource.RLIMIT_CPU: confinement.cpu_s,
        resource.RLIMIT_FSIZE: confinement.file_bytes,
        resource.RLIMIT_AS: confinement.memory_bytes,
        resource.RLIMIT_CORE: 0,
        resource.RLIMIT_NOFILE: 1024,
    }

    def confine() -> None:
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)  # a killed supervisor takes its program with it
        libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
        for kind, wanted in limits.items():
            _, hard = resource.getrlimit(kind)
            top = wanted if hard == resource.RLIM_INFINITY else min(wanted, hard)
            resource.setrlimit(kind, (top, top))

    return confine
