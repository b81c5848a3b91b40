"""Who supervises a job: the processes that hold its lock, whether they were started or forked."""

import os
from pathlib import Path

from worldwright.model.evidence.run import Run
from worldwright.stage.job import Job


def supervisors(run: Run, job: str = "") -> list[int]:
    """The process numbers of the supervisors of a run's jobs, or of one of them."""
    locks = {str((one.folder / "lock").resolve()) for one in Job.all(run) if job in ("", one.folder.name)}
    found = set()
    for entry in Path("/proc").glob("[0-9]*/fd/*"):
        try:
            if str(entry.readlink()) in locks:
                found.add(int(entry.parts[2]))
        except OSError:  # it has ended, or is another user's
            continue
    return sorted(found - {os.getpid()})
