"""Repeat physics with a difference: half the time step, a cause taken away. The result lies beside the evidence, never in
its place.

A variant runs the same program and plan in the same sandbox with more words on its command line; its result lies
at `evidence/<key>/physics@<variant>/` with a `result.json` like any pass. It proves nothing by itself: no gate counts
it. Audits compare it with the physics pass.
"""

import re
import time
from collections.abc import Sequence
from pathlib import Path

from ..model.errors import JobError
from ..model.evidence import environment
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from ..model.progress import Progress, silent
from .gates import folder_name, passed
from .job import Job, JobStatus
from .launch import MEMORY_MB, STILL_S, launch

NAME = re.compile(r"[a-z0-9][a-z0-9_.-]{0,79}")


def run(
    run: Run,
    variant: str,
    arguments: Sequence[str],
    *,
    still_s: float = STILL_S,
    memory_mb: int = MEMORY_MB,
    timeout_s: float = 40.0,
    progress: Progress = silent,
) -> JobStatus:
    """Run the physics pass of the current key as a variant; call again while it is still running.

    A variant that exists already with the same arguments costs nothing; one that is under way is joined. With `timeout_s` 0
    it is started, and the call returns at once.

    Args:
        run: the run; its physics pass must have succeeded.
        variant: its name, lower-case letters, digits, `_`, `.` and `-`, e.g. `half-step` or `without-foot`.
        arguments: words appended to the program's command line, e.g. `("--time-step-factor", "0.5")`.
        still_s: the job ends when nothing advances for so long, s.
        memory_mb: resident memory limit, MiB.
        timeout_s: the call returns after so long at the latest, s.
        progress: receives how far the job is.

    Returns:
        The job; its result is at `folder(run, variant)` once `state` is "succeeded".

    Raises:
        GateError: physics has not passed on this key.
        JobError: the name is not usable, or has been used with other arguments.
    """
    if not NAME.fullmatch(variant):
        raise JobError(
            f"'{variant}' is no name for a variant",
            code="refused",
            next_move="use lower-case letters, digits, '_', '.' and '-', at most 80",
        )
    key = run.evidence_key(environment.current().sha256())
    status = launch(
        run, key, "physics", variant=variant, arguments=tuple(arguments), still_s=still_s, memory_mb=memory_mb
    )
    if status.ended:
        return status
    return follow(Job.find(run, status.job), timeout_s, progress)


def follow(job: Job, timeout_s: float, progress: Progress = silent) -> JobStatus:
    """Read a job until it ends or `timeout_s` has passed, passing on its progress."""
    deadline = time.monotonic() + timeout_s
    told: tuple[float, float | None] = (-1.0, None)
    while True:
        state = job.read()
        left = f", about {state.eta_s:.0f} s left" if state.eta_s is not None else ""
        # Progress never goes back, which a client would take for another task.
        if state.state == "running" and state.done >= told[0] and (state.done, state.eta_s) != told:
            told = (state.done, state.eta_s)
            progress(state.done, state.total, f"{state.name} {state.done:g}/{state.total:g} {state.unit}{left}")
        if state.ended or time.monotonic() >= deadline:
            return state
        time.sleep(0.05)


def folder(run: Run, variant: str, key: EvidenceKey | None = None) -> Path | None:
    """The folder of a variant's result (`trajectory/` inside), or None while it has not succeeded on this key."""
    key = key or run.evidence_key(environment.current().sha256())
    if passed(run, key, "physics", variant) is None:
        return None
    return run.evidence(key) / folder_name("physics", variant)
