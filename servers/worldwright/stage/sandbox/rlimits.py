"""Resource limits alone: processor time, file size, address space, no core dumps.

This is the weakest level, which stops accidents, not intent, and the common floor of the stronger ones. Source:
setrlimit(2).
"""

import contextlib
import os
from collections.abc import Callable
from pathlib import Path

from .. import family
from .confinement import Confinement

PR_SET_PDEATHSIG = 1
PR_SET_NO_NEW_PRIVS = 38
CPU_GRACE_S = 2
"""Seconds between the signal that names the limit (SIGXCPU) and the one that cannot be caught."""


def unavailable() -> str:
    """Why this level cannot be tried here; empty when it can."""
    return "" if os.name == "posix" else "there are no POSIX resource limits on this system"


def command(call: list[str], confinement: Confinement, denial: int) -> list[str]:
    """The call as it is."""
    return call


def facts() -> dict[str, str]:
    """What the evidence records about this level."""
    return {}


def before_exec(confinement: Confinement) -> Callable[[], None]:
    """The function that the child calls between fork and exec."""
    import ctypes
    import resource
    import signal

    libc = ctypes.CDLL(None, use_errno=True)
    limits = {
        resource.RLIMIT_CPU: (confinement.cpu_s, confinement.cpu_s + CPU_GRACE_S),
        resource.RLIMIT_FSIZE: (confinement.file_bytes, confinement.file_bytes),
        resource.RLIMIT_AS: (confinement.memory_bytes, confinement.memory_bytes),
        resource.RLIMIT_CORE: (0, 0),
        resource.RLIMIT_NOFILE: (1024, 1024),
    }
    token = getattr(resource, "RLIMIT_MSGQUEUE", None)
    if confinement.token and token is not None:
        limits[token] = family.mark(confinement.token)

    def confine() -> None:
        libc.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)  # a killed supervisor takes its program with it
        libc.prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0)
        with contextlib.suppress(OSError):  # when the machine runs out of memory, the job goes first
            Path("/proc/self/oom_score_adj").write_text("1000")
        for kind, (soft, hard) in limits.items():
            _, most = resource.getrlimit(kind)
            if most != resource.RLIM_INFINITY and kind != token:
                soft, hard = min(soft, most), min(hard, most)
            with contextlib.suppress(ValueError):
                resource.setrlimit(kind, (soft, hard))

    return confine
