"""The sandbox ladder: bubblewrap, then Landlock with seccomp, then resource limits alone.

The strongest level that really works here is used and recorded in the evidence. `WORLDWRIGHT_SANDBOX` picks a level
by name (a weaker one for debugging, or a stronger one to be refused without it).
"""

import contextlib
import hashlib
import json
import os
from functools import lru_cache
from pathlib import Path

from worldkit.data_folders import data_root
from worldkit.files import write_json

from ...model.errors import JobError
from . import bubblewrap, landlock, probe, rlimits
from .confinement import Confinement

LADDER = {"bubblewrap": bubblewrap, "landlock": landlock, "rlimits": rlimits}
CONFINING = ("bubblewrap", "landlock")
"""Levels that must withstand the probe; the lowest one only limits accidents."""
REMEMBERED = 8
"""So many states in which a level works are kept, the newest first."""

__all__ = ["CONFINING", "LADDER", "Confinement", "level", "unusable"]


@lru_cache
def level() -> str:
    """The name of the strongest level that works.

    Raises:
        JobError: `WORLDWRIGHT_SANDBOX` names a level that is unknown or does not work here.
    """
    wanted = os.environ.get("WORLDWRIGHT_SANDBOX", "")
    if wanted and wanted not in LADDER:
        raise JobError(
            f"there is no sandbox level '{wanted}'",
            code="refused",
            place="WORLDWRIGHT_SANDBOX",
            next_move=f"use one of: {', '.join(LADDER)}",
        )
    for name in (wanted,) if wanted else LADDER:
        reason = unusable(name)
        if not reason:
            return name
        if wanted:
            raise JobError(
                f"the sandbox level '{wanted}' does not work here: {reason}",
                code="refused",
                place="WORLDWRIGHT_SANDBOX",
                next_move="unset WORLDWRIGHT_SANDBOX to use the strongest level that does",
            )
    return "rlimits"


def unusable(name: str) -> str:
    """Why a level does not work here; empty when a program inside it tried to get out and failed.

    That a level works is remembered, in the user's data folder, which no agent's shell writes, until the machine, the user,
    bubblewrap, our own sources or what this process may do change; those of several installations are, side by side, since
    each of their jobs asks. That it does not is never believed from a file: it would take the protection away.
    """
    if reason := LADDER[name].unavailable():
        return reason
    if name not in CONFINING:
        return ""
    kept = data_root() / f"sandbox-{name}-{os.geteuid()}.json"
    state = _state()
    try:
        known = [str(one) for one in json.loads(kept.read_text(encoding="utf-8"))["works"]]
    except (OSError, ValueError, KeyError, TypeError):
        known = []
    if state in known:
        return ""
    possible, _, broken = probe.ways_out(LADDER[name])
    reason = broken or (f"a confined program could: {', '.join(possible)}" if possible else "")
    if not reason:
        with contextlib.suppress(OSError):  # with a read-only home the probe runs again: it costs time, not safety
            kept.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            write_json(kept, {"works": [state, *known][:REMEMBERED]})
    return reason


def _state() -> str:
    """A hash of everything that the probe's outcome depends on."""
    import shutil
    import sys

    digest = hashlib.sha256()
    for path in sorted(Path(__file__).parent.glob("*.py")):
        digest.update(path.read_bytes())
    for path in (Path("/proc/sys/kernel/random/boot_id"), Path("/proc/version")):
        digest.update(path.read_bytes() if path.exists() else b"")
    # An agent's shell, and what it starts, may mount nothing: there bubblewrap does not work, and outside of it does.
    with contextlib.suppress(OSError):
        lines = Path("/proc/self/status").read_text(encoding="utf-8").splitlines()
        digest.update("\n".join(line for line in lines if line.startswith(("NoNewPrivs", "Seccomp:"))).encode())
    for program in (shutil.which("bwrap"), sys.executable):
        if program:
            stat = Path(program).stat()
            digest.update(f"{program} {stat.st_size} {stat.st_mtime_ns}".encode())
    return digest.hexdigest()
