"""Proving an accepted world again: every byte as stamped, and the program run anew moves as it did.

On the stamped build and processor family the trajectory must repeat bit for bit. Elsewhere the sampled motion must stay
within a stated tolerance and every expectation must come out as stamped; what differs is named. The accepted folder is
only read: the program runs from a copy in a private temporary folder.
"""

import hashlib
import os
import shutil
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from ..model import imported
from ..model.errors import GateError, NotFoundError, WorldwrightError
from ..model.evidence import Environment, ExpectReport
from ..model.frozen import Frozen
from ..model.journal import Journal
from ..model.progress import Progress, silent
from ..model.run import Run
from ..model.storage import writing
from . import bundle, digest, machine, signing
from .kept import Kept
from .proof import Proved, prove
from .state import State
from .statement import Statement


class Check(Frozen):
    """One thing that was checked."""

    name: str
    ok: bool
    detail: str


class Verification(Frozen):
    """The answer of `verify`."""

    run: str
    state: Literal["proved", "refuted", "running"]
    """`running`: the run needs longer than this call may take; it goes on by itself."""
    mode: Literal["bitwise", "tolerance", ""] = ""
    """How the motion was compared."""
    checks: tuple[Check, ...] = ()
    environment_differences: tuple[str, ...] = ()
    """What differs between the stamped environment and this one."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """The world was proved again."""
        return self.state == "proved"

    def text(self) -> str:
        """What a person reads."""
        lines = [f"{self.run}: {self.state}" + (f" ({self.mode})" if self.mode else "")]
        lines += [f"  {'ok  ' if c.ok else 'FAIL'} {c.name}: {c.detail}" for c in self.checks]
        lines += [f"  differs here: {text}" for text in self.environment_differences]
        return "\n".join(lines + ([f"  next: {self.next_move}"] if self.next_move else []))


def verify(name: str, timeout_s: float, progress: Progress = silent, signer: Path | None = None) -> Verification:
    """Check and re-run an accepted world: a run folder that holds `accepted/`, or an accepted folder itself.

    With `signer`, a public key, the stamp must have been signed with it.
    """
    run, folder = _locate(name)
    checks, statement = static(run, folder, signer), Kept.read(folder / bundle.STAMP, Statement).value
    if statement is None or not all(c.ok for c in checks):
        return _refuted(run, checks)
    here = _here()
    differences = tuple(environment_differences(statement.predicate.environment, statement.predicate.cpu, here))
    with writing("the copy to be run", Path(tempfile.gettempdir())):
        scratch = _scratch(folder, statement, here)
    with writing("the copy to be run", scratch), bundle.only_one(Run(scratch)):
        proof = scratch / "proof"
        try:
            proved = prove(
                proof,
                (folder / "simulation.py").read_bytes(),
                (folder / "plan.md").read_bytes(),
                reason=f"stamped as {statement.predicate.run}",
                timeout_s=timeout_s,
                progress=progress,
                beside=imported.beside(folder),
            )
        except GateError as error:
            shutil.rmtree(proof, ignore_errors=True)
            checks.append(Check(name="run", ok=False, detail=str(error)))
            return _refuted(run, checks, differences)
        if proved is None:
            return Verification(
                run=run.name,
                state="running",
                checks=tuple(checks),
                environment_differences=differences,
                next_move=f"worldwright stamp verify {name}",
            )
        mode, found = _motion(folder, statement, proved, differences)
        checks += found
        checks += _objectives(statement, proved)
    shutil.rmtree(scratch, ignore_errors=True)
    if not all(c.ok for c in checks):
        return _refuted(run, checks, differences, mode)
    return Verification(
        run=run.name, state="proved", mode=mode, checks=tuple(checks), environment_differences=differences
    )


def environment_differences(stamped: Environment, cpu: str, here: Environment) -> Iterator[str]:
    """What differs between the stamped environment and this one, one line each."""
    for name in ("python", "machine"):
        if getattr(stamped, name) != getattr(here, name):
            yield f"{name}: {getattr(here, name)} (stamped {getattr(stamped, name)})"
    for name in sorted({*stamped.packages, *here.packages}):
        then, now = stamped.packages.get(name, "absent"), here.packages.get(name, "absent")
        if then != now:
            yield f"{name}: {now} (stamped {then})"
    for name in ("simulator", "worldkit", "catalog"):
        then, now = getattr(stamped, f"{name}_sha256"), getattr(here, f"{name}_sha256")
        if then != now:
            yield f"{name}: sha256 {now[:16]} (stamped {then[:16]})"
    if cpu and cpu != machine.cpu():
        yield f"processor: {machine.cpu()} (stamped {cpu})"


def _locate(name: str) -> tuple[Run, Path]:
    state = State.find(name)
    run = state.run
    if (run.folder / bundle.STAMP).is_file() and not run.accepted.exists():
        return run, run.folder
    if not run.accepted.is_dir():
        raise NotFoundError(
            f"{state.place} has not been accepted",
            place=str(run.accepted),
            next_move=f"worldwright stamp status {state.place}",
        )
    return run, run.accepted


def static(run: Run, folder: Path, signer: Path | None = None) -> list[Check]:
    """What can be checked of an accepted folder without running anything."""
    kept = Kept.read(folder / bundle.STAMP, Statement)
    if kept.value is None:
        return [Check(name="stamp", ok=False, detail=kept.problem or "there is no stamp.json")]
    signed = signing.check(folder, bundle.STAMP, signer)
    return [
        *_static(run, folder, kept.value),
        *([] if signed is None else [Check(name="signature", ok=signed[0], detail=signed[1])]),
    ]


def _static(run: Run, folder: Path, statement: Statement) -> Iterator[Check]:
    broken = bundle.damage(folder, statement)
    count = len(statement.subject)
    yield Check(name="checksums", ok=not broken, detail="; ".join(broken[:5]) or f"{count} files as stamped")
    source = statement.predicate.source
    for what, name, wanted in (
        ("plan", "plan.md", source.plan_sha256),
        ("prompt", "prompt.md", source.prompt_sha256),
    ):
        if wanted and statement.digest_of(name) != wanted:
            yield Check(name=what, ok=False, detail=f"{name} is not the one that was approved")
    wrong = _journal(run, statement, bundle.sha256_file(folder / bundle.STAMP)) if run.journal.is_file() else None
    if wrong is not None:
        yield Check(name="journal", ok=not wrong, detail=wrong or "unbroken, and it knows this stamp")


def _journal(run: Run, statement: Statement, stamped: str) -> str | None:
    """What the run's journal says against this stamp; empty when it agrees, None when it has no word on it."""
    journal = Journal(run.journal)
    broken, head = journal.breaks(), statement.predicate.journal_head
    if broken:
        return broken[0]
    if head and head not in journal.heads():
        return "it lacks the line that stood last when the stamp was made"
    accepts = [e for e in State(run).journal if e.get("action") == "accept"]
    if accepts and not any(e.get("stamp_sha256") == stamped for e in accepts):
        return "it does not know this stamp"
    return "" if accepts else None


def _motion(
    folder: Path, statement: Statement, proved: Proved, differences: tuple[str, ...]
) -> tuple[Literal["bitwise", "tolerance"], list[Check]]:
    """How the motions compare: (mode, checks)."""
    wanted, got = statement.predicate.proof.trajectory_sha256, proved.trajectory_sha256
    if wanted == got:
        return "bitwise", [Check(name="trajectory", ok=True, detail=f"bitwise identical, sha256 {got[:16]}")]
    stamped = digest.stamped_motion(folder, statement)
    difference = digest.compare(stamped, digest.motion(proved.recording)) if stamped else None
    apart = difference.message if difference else "no stamped motion to compare with"
    if not differences:
        detail = f"sha256 {got[:16]}, stamped {wanted[:16]}, on the same build and processor; {apart}"
        return "bitwise", [Check(name="trajectory", ok=False, detail=detail)]
    within = bool(difference and difference.within)
    detail = f"{'within' if within else 'outside'} the tolerance ({digest.TOLERANCE}); {apart}"
    return "tolerance", [Check(name="trajectory", ok=within, detail=detail)]


def _objectives(statement: Statement, proved: Proved) -> Iterator[Check]:
    """The expectations and the anomaly scan of the new recording."""
    from ..scan import tools as scan

    try:
        report: ExpectReport = scan.expect(str(proved.run.folder))
        scanned = scan.scan(str(proved.run.folder))
    except WorldwrightError as error:
        yield Check(name="expectations", ok=False, detail=str(error))
        return
    stamped = {(e.objective, e.name, i): e.status for i, e in enumerate(statement.predicate.expectations)}
    flat = [(o.index, e) for o in report.objectives for e in o.expectations]
    now = {(index, e.name, i): e.status for i, (index, e) in enumerate(flat)}
    changed = [
        f"{name} of objective {index} is {now.get((index, name, i), 'gone')} (stamped {status})"
        for (index, name, i), status in stamped.items()
        if now.get((index, name, i)) != status
    ]
    before = {o.index: o.status for o in statement.predicate.objectives}
    changed += [
        f"objective {o.index} is {o.status} (stamped {before.get(o.index, 'absent')})"
        for o in report.objectives
        if before.get(o.index) != o.status
    ]
    yield Check(
        name="expectations", ok=not changed, detail="; ".join(changed[:5]) or f"all as stamped ({len(stamped)})"
    )
    blocking = [a for a in scanned.anomalies if a.severity == "blocking"]
    checks = sum(c.status != "skipped" for c in scanned.checks)
    yield Check(name="scan", ok=not blocking, detail=str(blocking[0]) if blocking else f"{checks} checks, none blocks")


def _refuted(
    run: Run, checks: list[Check], differences: tuple[str, ...] = (), mode: Literal["bitwise", "tolerance", ""] = ""
) -> Verification:
    return Verification(
        run=run.name,
        state="refuted",
        mode=mode,
        checks=tuple(checks),
        environment_differences=differences,
        next_move="restore the accepted folder from version control, or accept the run again",
    )


def _here() -> Environment:
    from ..model import environment

    return environment.current()


def _scratch(folder: Path, statement: Statement, here: Environment) -> Path:
    """A private folder that a later call of the same verification finds again."""
    identity = "\n".join((str(folder), bundle.sha256_file(folder / bundle.STAMP), here.sha256()))
    root = Path(tempfile.gettempdir()) / f"worldwright-{os.getuid()}"
    root.mkdir(mode=0o700, exist_ok=True)
    owner = root.lstat()
    if owner.st_uid != os.getuid() or root.is_symlink() or owner.st_mode & 0o077:
        root = Path(tempfile.mkdtemp(prefix="worldwright-"))  # somebody else holds the name
    scratch = root / f"verify-{hashlib.sha256(identity.encode()).hexdigest()[:16]}"
    scratch.mkdir(mode=0o700, exist_ok=True)
    return scratch
