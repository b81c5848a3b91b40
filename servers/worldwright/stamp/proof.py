"""The proof run: a program and its plan, alone in a new folder, linted and simulated again in the sandbox.

Nothing of the original run is there to take results from, so the result is new evidence. The folder is named after what it
proves, so that a later call finds it again while its job is still running, or after a crash.
"""

import json
import shutil
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

from worldkit.files import write_atomic

from ..model import companions
from ..model.errors import GateError, JobError, WorldwrightError
from ..model.evidence import approval
from ..model.evidence.reports import ExpectReport, LintReport, PassResult
from ..model.evidence.run import Run
from ..model.plan import imported
from ..model.progress import Progress, silent
from .kept import Kept

POLL_S = 20.0
OF_THE_MACHINE = ("disk_full", "not_writable", "out_of_memory", "killed", "internal")
"""Codes of jobs that a machine with more room may have brought to their end: the kernel kills (SIGKILL) where memory is short."""
WORLD = "world.mjz"
"""Name of the world's file, as `worldkit.portable` writes it."""


@dataclass(frozen=True)
class Proved:
    """What the proof run gave."""

    run: Run
    physics: PassResult
    lint: LintReport
    recording: Path
    world: Path | None = None
    """The file of the world that was simulated."""
    rebuilt: str = ""
    """How the world that the program builds now compares with the one that was kept; empty when none was."""
    earlier: bool = False
    """An earlier call had it simulated: this one found the result."""

    @property
    def began(self) -> str:
        """When it was simulated, ISO 8601, UTC."""
        return self.physics.started

    @property
    def key(self) -> str:
        """The evidence key that it was simulated under."""
        return self.recording.parents[1].name

    @property
    def world_sha256(self) -> str:
        """Hash of the world's file."""
        return str(self.physics.files.get(WORLD, ""))

    @property
    def content_sha256(self) -> str:
        """Hash of what the world's file holds, however it is packed; empty when there is no file."""
        from worldkit import closed_archive

        return closed_archive.content_sha256(self.world) if self.world else ""

    @property
    def inputs_sha256(self) -> str:
        """Hash of what was sent to the world while it ran, computed here; empty when nothing was."""
        from worldengine.recording import stored

        return stored.inputs_digest(self.recording)

    @property
    def trajectory_sha256(self) -> str:
        """Hash of the new trajectory."""
        return str(self.physics.summary.get("trajectory_sha256", ""))


FACTS = ("program.json", "inputs.json")
DRIVEN = ("inputs.arrows", "edits.arrows", "media.arrows", "balances.arrows")
"""Files with the inputs that drove a world, as `worldengine.recording` names them."""


def replay(
    folder: Path,
    program: bytes,
    plan: bytes,
    given: Path,
    *,
    timeout_s: float,
    progress: Progress = silent,
    near: Mapping[str, bytes] | None = None,
) -> Proved | None:
    """Simulate a world that is there as a file, by the inputs recorded of it, without its program; see `prove`.

    Args:
        folder: where, a new one.
        program, plan: what the evidence is about; the program is not run.
        given: the world, its facts, and what it was driven by (`lay_out`).
        timeout_s, progress, near: as for `prove`.
    """
    from ..stage import tools as stage

    deadline = time.monotonic() + timeout_s
    run = Run(folder)
    _lay(folder, {run.program.name: program, run.plan.name: plan, **(near or {})})
    job = stage.simulate_given(run, given)
    return _followed(run, job, LintReport(), deadline, progress, "the world, driven by its recorded inputs,")


def lay_out(given: Path, world: Path, facts: Path, recording: Path | None = None) -> Path:
    """Fill a folder for `replay`: the world, its facts, and the inputs that drove the recording, where there are any."""
    for path in (world, *(facts / name for name in FACTS)):
        write_atomic(given / path.name, path.read_bytes())
    for path in (recording / name for name in DRIVEN if recording):
        if path.is_file():
            write_atomic(given / path.name, path.read_bytes())
    return given


def _lay(folder: Path, files: Mapping[str, bytes]) -> None:
    """Write what is not there yet, or is otherwise: an earlier call may have been killed meanwhile, or was given other files."""
    for name, content in files.items():
        if _bytes(folder / name) != content:
            write_atomic(folder / name, content)


def beside(folder: Path) -> dict[str, bytes]:
    """The files beside a plan and its program that belong to them: model files that the plan names, and companions."""
    return {**imported.beside(folder), **companions.of(folder / "simulation.py")}


def driven_by(proved: Proved) -> list[Path]:
    """The facts of the program, and the inputs that drove the world, where there are any."""
    facts = [proved.recording.parent / name for name in FACTS]
    driven = (proved.recording / name for name in DRIVEN if proved.inputs_sha256)
    return [*facts, *(path for path in driven if path.is_file())]


def prove(
    folder: Path,
    program: bytes,
    plan: bytes,
    *,
    reason: str,
    timeout_s: float,
    progress: Progress = silent,
    near: Mapping[str, bytes] | None = None,
    kept: Path | None = None,
    elsewhere: bool = False,
    linted: bool = True,
) -> Proved | None:
    """Build, lint and simulate `program` against `plan` in `folder`; None when a job needs more than `timeout_s`.

    With `kept`, a folder that `lay_out` filled, the program must build the world that lies there (`rebuilt.compare`). That
    file is then what is simulated, unless the program has a `control` or a law of its own, which is asked again.

    Args:
        folder: where, a new one.
        program, plan: what is proved.
        reason: why the plan counts as approved here.
        timeout_s, progress: how long a call may take, and whom to tell how far it is.
        near: the files that belong to them, by relative path.
        kept: the world that was accepted, or is to be.
        elsewhere: it was built in another environment or on another processor.
        linted: whether today's lint rules are asked, too.

    Raises:
        GateError: a lint error, a failed pass, or another world than the kept one.
        JobError: a pass ended for want of room, or because somebody ended it.
    """
    from ..stage import tools as stage

    deadline = time.monotonic() + timeout_s
    run = Run(folder)
    _lay(folder, {run.program.name: program, run.plan.name: plan, **(near or {})})
    key = run.evidence_key(_environment_sha256())
    models = approval.model_hashes(run)
    if approval.standing(run.entries(), key.plan_sha256, models) is None:
        run.log("stamp", "approve", plan_sha256=key.plan_sha256, by=reason, models=models)
    # Lint looks at the world that is then simulated; where it cannot be built, lint says why.
    built = _ended(run, stage.start_fresh(run, "bundle"), deadline, progress)
    if built is None:
        return None
    failure = None if built.state == "succeeded" else _failed(built, "the program does not build its world again")
    if isinstance(failure, JobError):  # before lint, which would tell the machine's want as the program's fault
        raise failure
    found = _linted(run) if linted else LintReport()
    if failure:
        raise failure
    if not linted:
        run.keep(key, "lint", found)  # a pass asks for a report: this one says that no rule was asked
    told = _rebuilt(run, kept, elsewhere=elsewhere) if kept else ""
    given = kept if kept and not _controlled(kept) else None
    job = stage.simulate_given(run, given) if given else stage.start_fresh(run, "physics")
    proved = _followed(run, job, found, deadline, progress)
    return proved and replace(proved, rebuilt=told)


def _linted(run: Run) -> LintReport:
    """What lint says of the program and the world that it has built (`GateError` for an error)."""
    from ..lint import tools as lint

    report = lint.check_program([run.program], plan=run.plan)
    if errors := [f for f in report.findings if f.severity == "error"]:
        raise GateError(
            f"the program does not lint clean: {errors[0].code} {errors[0].message} ({len(errors)} error(s))",
            place=f"{run.program.name}:{errors[0].line or 1}",
            next_move=errors[0].fix or "correct it and run it again",
        )
    return LintReport(findings=tuple(report.findings), rules=report.rules)


def _rebuilt(run: Run, kept: Path, *, elsewhere: bool) -> str:
    """Compare the world that the program has built in the proof's folder with the kept one (`GateError` if it is another)."""
    from . import rebuilt

    built = run.evidence(run.evidence_key(_environment_sha256())) / "bundle"
    try:
        files = [tuple(folder / name for name in FACTS) for folder in (kept, built)]
        rebuilt.same_facts(*files, elsewhere=elsewhere)
        return rebuilt.compare(kept / WORLD, built / WORLD, elsewhere=elsewhere)
    except rebuilt.OtherWorldError as cause:
        shutil.rmtree(run.folder, ignore_errors=True)  # or the next call would take its result from it
        raise GateError(
            f"the program builds another world than {WORLD} that was kept of it: {cause}",
            place=run.program.name,
            next_move="seed every random draw and read no clock; instrumentation must only watch; then run it again",
        ) from cause


def _controlled(kept: Path) -> bool:
    """Whether a world's program has a control or a law of its own, by the facts beside its file."""
    try:
        facts = json.loads((kept / FACTS[0]).read_bytes())
        return bool(facts.get("control") or facts.get("laws"))
    except (OSError, ValueError, AttributeError):
        return True  # what cannot be read is asked again


def measure(proved: Proved, progress: Progress = silent) -> ExpectReport:
    """Measure the expectations in the proof run. Where one is measured in stills, they are drawn of it first."""
    from ..scan import tools as scan
    from ..stage import tools as stage

    folder = str(proved.run.folder)
    report: ExpectReport = scan.expect(folder)
    if report.waits:
        job = stage.start(folder, stage="stills")
        while job.state in ("queued", "running"):
            job = stage.wait(folder, job=job.job, timeout_s=POLL_S, progress=progress)
        if job.state != "succeeded":
            raise _failed(job, "its stills cannot be drawn again")
        report = scan.expect(folder)
    return report


def _followed(
    run: Run, job: Any, lint: LintReport, deadline: float, progress: Progress, what: str = "the program"
) -> Proved | None:
    """Follow a physics job to its end, and look at what it left; None when it needs longer."""
    key, earlier = run.evidence_key(_environment_sha256()), bool(job.cached)
    job = _ended(run, job, deadline, progress)
    if job is None:
        return None
    result = Kept.read(run.evidence(key) / "physics" / "result.json", PassResult)
    if job.state != "succeeded" or result.value is None or not result.value.ok:
        raise _failed(job, f"{what} does not run again", result.problem)
    recording = run.evidence(key) / "physics" / "trajectory"
    world = recording.parent / WORLD
    proved = Proved(
        world=world if world.is_file() else None,
        run=run,
        physics=result.value,
        lint=lint,
        recording=recording,
        earlier=earlier,
    )
    recorded = _recorded_sha256(recording)
    if recorded != proved.trajectory_sha256:
        raise GateError(
            f"the program reports trajectory {proved.trajectory_sha256[:16]}, but what it recorded is {recorded[:16]}",
            place=str(recording),
            next_move="let worldkit record the run and write its result; change neither",
        )
    return proved


def _failed(job: Any, what: str, problem: str = "") -> WorldwrightError:
    """A job that did not succeed: of the machine's or a person's doing it says nothing about the world, else it refuses."""
    told: dict[str, str] = {
        "cause": f"{what}: {job.code}: {job.message or problem or job.state}",
        "place": job.place,
        "next_move": job.next_move or "call it again; a program that runs once must run twice",
    }
    if job.state in ("cancelled", "lost") or job.code in OF_THE_MACHINE:
        return JobError(code=job.code, **told)
    return GateError(**told)


def _ended(run: Run, job: Any, deadline: float, progress: Progress) -> Any:
    """Follow a job to its end; None when it needs longer."""
    from ..stage import tools as stage

    while job.state in ("queued", "running"):
        left = deadline - time.monotonic()
        if left <= 0:
            return None
        job = stage.wait(str(run.folder), job=job.job, timeout_s=min(POLL_S, max(left, 0.1)), progress=progress)
    return job


def _recorded_sha256(recording: Path) -> str:
    """The trajectory's hash, computed here from the recorded rows: what the program reports is no evidence."""
    from worldengine.recording import stored

    try:
        return stored.digest(stored.open(recording))
    except stored.RecordingError as error:
        raise GateError(f"the recording cannot be read: {error}", place=str(recording)) from error


def _environment_sha256() -> str:
    from ..model.evidence import environment

    return environment.current().sha256()


def _bytes(path: Path) -> bytes | None:
    try:
        return path.read_bytes()
    except OSError:
        return None
