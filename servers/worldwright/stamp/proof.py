"""The proof run: a program and its plan, alone in a new folder, linted and simulated again in the sandbox.

Nothing of the original run is there to be answered from, so its result is new evidence. The folder may be met again by
a later call while its job is still running, or after a crash: it is addressed by what it proves.
"""

import time
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from worldkit.files import write_atomic

from ..model import approval
from ..model.errors import GateError
from ..model.evidence import LintReport, PassResult
from ..model.progress import Progress, silent
from ..model.run import Run
from .kept import Kept

POLL_S = 20.0
WORLD = "world.mjz"
"""As `worldkit.portable` names it."""


@dataclass(frozen=True)
class Proved:
    """What the proof run gave."""

    run: Run
    physics: PassResult
    lint: LintReport
    recording: Path
    world: Path | None = None
    """The world as one file, when it was asked for and could be written."""
    no_world: str = ""
    """Why not."""

    @property
    def trajectory_sha256(self) -> str:
        """Hash of the new trajectory."""
        return str(self.physics.summary.get("trajectory_sha256", ""))


def prove(
    folder: Path,
    program: bytes,
    plan: bytes,
    *,
    reason: str,
    timeout_s: float,
    progress: Progress = silent,
    bundle: bool = False,
    beside: Mapping[str, bytes] | None = None,
) -> Proved | None:
    """Lint and simulate `program` against `plan` in `folder`; None when a job needs more than `timeout_s`.

    `beside` are files that the plan names, by relative path. With `bundle` the world is also written as one file (a second job). A lint error or a failed pass is a `GateError`.
    """
    from ..lint import tools as lint
    from ..stage import tools as stage

    deadline = time.monotonic() + timeout_s
    run = Run(folder)
    if _bytes(run.program) != program or _bytes(run.plan) != plan:
        write_atomic(run.program, program)
        write_atomic(run.plan, plan)
        for name, content in (beside or {}).items():
            write_atomic(folder / name, content)
    key = run.evidence_key(_environment_sha256())
    models = approval.model_hashes(run)
    if approval.standing(run.entries(), key.plan_sha256, models) is None:
        run.log("stamp", "approve", plan_sha256=key.plan_sha256, by=reason, models=models)
    report = lint.check_program([run.program], plan=run.plan)
    errors = [f for f in report.findings if f.severity == "error"]
    if errors:
        raise GateError(
            f"the program does not lint clean: {errors[0].code} {errors[0].message} ({len(errors)} error(s))",
            place=f"{run.program.name}:{errors[0].line or 1}",
            next_move=errors[0].fix or "correct it and run it again",
        )
    job = stage.start(str(folder), stage="physics")
    while job.state in ("queued", "running"):
        left = deadline - time.monotonic()
        if left <= 0:
            return None
        job = stage.wait(str(folder), job=job.job, timeout_s=min(POLL_S, max(left, 0.1)), progress=progress)
    result = Kept.read(run.evidence(key) / "physics" / "result.json", PassResult)
    if job.state != "succeeded" or result.value is None or not result.value.ok:
        raise GateError(
            f"the program does not run again: {job.code}: {job.message or result.problem or job.state}",
            place=job.place,
            next_move=job.next_move or "run it again; a program that runs once must run twice",
        )
    recording = run.evidence(key) / "physics" / "trajectory"
    world, missing = None, ""
    if bundle:
        made = stage.run_variant(
            run, "bundle", ("--pass", "bundle"), timeout_s=max(1.0, deadline - time.monotonic()), progress=progress
        )
        if not made.ended:
            return None
        found = stage.variant_folder(run, "bundle")
        world, missing = (found / WORLD, "") if found else (None, made.message or made.code)
    proved = Proved(
        world=world,
        no_world=missing,
        run=run,
        physics=result.value,
        lint=LintReport(findings=tuple(report.findings), rules=report.rules),
        recording=recording,
    )
    recorded = _recorded_sha256(recording)
    if recorded != proved.trajectory_sha256:
        raise GateError(
            f"the program reports trajectory {proved.trajectory_sha256[:16]}, but what it recorded is {recorded[:16]}",
            place=str(recording),
            next_move="let worldkit record the run and write its result; change neither",
        )
    return proved


def _recorded_sha256(recording: Path) -> str:
    """The trajectory's hash computed here, from the recorded rows: the program's own word is not evidence."""
    from worldkit import trajectory

    try:
        return trajectory.digest(trajectory.open(recording))
    except trajectory.RecordingError as error:
        raise GateError(f"the recording cannot be read: {error}", place=str(recording)) from error


def _environment_sha256() -> str:
    from ..model import environment

    return environment.current().sha256()


def _bytes(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None
