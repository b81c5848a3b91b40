"""Frames of a final pass outlive their job, so that the next one goes on where it ended, or was cut."""

import shutil

from ..model.evidence.run import Run
from .job import Job, Spec

FOLDER = "frames"
MINUTES = 5.0
MEMORY_MB = 6144
"""Tracing paths takes more memory than other passes."""


def arguments(minutes: float) -> tuple[str, ...]:
    """Words for the engine's command line."""
    return ("--minutes", f"{minutes:g}")


def put_aside(job: Job) -> None:
    """Keep the frames of a job that has ended, or was killed, beside its other files; they are no evidence."""
    drawn = job.out / FOLDER
    if job.spec.stage == "final" and drawn.is_dir() and not drawn.is_symlink():
        shutil.rmtree(job.folder / FOLDER, ignore_errors=True)
        drawn.rename(job.folder / FOLDER)


def carry_over(run: Run, spec: Spec, job: Job) -> None:
    """Move the frames of the last final pass of this recording and film to where the new one goes on with them.

    Those of other recordings and films are removed.
    """
    for other in Job.all(run):
        theirs, drawn = other.spec, other.folder / FOLDER
        if theirs.stage != "final" or theirs.job == spec.job or not drawn.is_dir() or not other.read().ended:
            continue
        goes_on = (theirs.key, theirs.film_sha256) == (spec.key, spec.film_sha256) and not spec.force
        if goes_on and not (job.out / FOLDER).exists():
            job.out.mkdir(parents=True, exist_ok=True)
            drawn.rename(job.out / FOLDER)
        else:
            shutil.rmtree(drawn, ignore_errors=True)
