"""Proving an accepted world again: every byte is as stamped, and the world, simulated anew, moves as it did.

Of a stamp that nobody known here signed, the program must also send the recorded inputs when it is asked again (`law_check`).

On the stamped build and processor family the trajectory must repeat bit for bit. Elsewhere the sampled motion must stay
within a stated tolerance and every expectation must come out as stamped; differences are listed. The accepted folder is
read once, into a private copy by which all of it is judged (`private_copy`); nothing is written there.
"""

import shlex
import shutil
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from ..model.errors import GateError, NotFoundError
from ..model.evidence import assets_used, environment
from ..model.evidence.reports import Environment
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..model.plan.plan_text import read_plan
from ..model.printable import line
from ..model.progress import Progress, silent
from ..model.storage import StorageError, writing
from . import (
    another_machine,
    bundle,
    departures,
    digest,
    exactness,
    law_check,
    measured_again,
    nobodys_words,
    private,
    private_copy,
    redrawn,
    signing,
    trials_again,
    world_facts,
)
from .as_stamped import Check, static
from .kept import Kept
from .proof import FACTS, WORLD, Proved, beside, lay_out, prove, replay
from .state import State
from .statement import Proof, Statement


class Verification(Frozen):
    """The answer of `verify`."""

    run: str
    state: Literal["proved", "refuted", "not_shown", "running"]
    """About the world alone: `proved` says nothing about who accepted it. `not_shown`: no yes, as it could not be proved here,
    and not refuted either. `running`: the work goes on, call again."""
    signature: signing.Signature | None = None
    """The signature on the stamp; without one by a key that is known here, the answer is no."""
    anybody: bool = False
    """The caller accepts any signer, known here or not."""
    mode: Literal["bitwise", "tolerance", ""] = ""
    """How the motion was compared."""
    checks: tuple[Check, ...] = ()
    environment_differences: tuple[str, ...] = ()
    """What differs between the stamped environment and this one."""
    next_move: str = ""

    @property
    def ok(self) -> bool:
        """Whether the world was proved again and its signer is known here (or any signer will do)."""
        return self.state == "proved" and (self.anybody or bool(self.signature and self.signature.vouched))

    @property
    def exit_code(self) -> int:
        """0 for yes, 3 for a world that is proved but that nobody known here vouches for, 1 for any other no."""
        return 0 if self.ok else 3 if self.state == "proved" else 1

    def text(self) -> str:
        """The answer as a person reads it."""
        who = f", {'' if self.signature.vouched else 'but '}{self.signature.text()}" if self.signature else ""
        state = "not shown here" if self.state == "not_shown" else self.state
        lines = [line(f"{self.run}: {state}" + (f" ({self.mode})" if self.mode else "") + who)]
        lines += [
            f"  {'note' if c.note else 'ok  ' if c.ok else 'open' if c.open else 'FAIL'} {c.name}: {line(c.detail)}"
            for c in self.checks
        ]
        lines += [f"  differs here: {line(text)}" for text in self.environment_differences]
        return "\n".join(lines + ([f"  next: {line(self.next_move)}"] if self.next_move else []))


def verify(
    name: str,
    timeout_s: float,
    progress: Progress = silent,
    signer: Path | None = None,
    anybody: bool = False,
    rebuild: bool = False,
    every: bool = False,
) -> Verification:
    """Check and re-run an accepted world: a run folder, its small form, or an accepted folder itself.

    With `signer`, a public key, the stamp must have been signed with it. With `anybody`, a world that nobody known here
    vouches for is a yes too, when it is proved again. With `rebuild`, the program is run even where its world is kept.
    With `every`, every repetition of its audits is simulated again, not one part of them that is drawn (`trials_again`).
    """
    live = _locate(name)
    with private_copy.of(live) as run:
        found = _prove_again(live, run, timeout_s, progress, signer, rebuild, every)
        signature = None if found.state == "refuted" else signing.check(run.stamped, bundle.STAMP, signer)
    move, asked = found.next_move, {"--rebuild": rebuild, "--every-trial": every}
    if found.state == "running":
        move = _command(name, signer, {"--anybody": anybody, **asked})
    elif signature is not None and not signature.vouched and not anybody and found.state == "proved":
        move = _vouch(signature, _command(name, signer, {"--anybody": True, **asked}))
    return found.model_copy(update={"signature": signature, "anybody": anybody, "next_move": move})


def _command(name: str, signer: Path | None, asked: dict[str, bool]) -> str:
    """The command that goes on with what was asked."""
    words = (*(("--signer", str(signer)) if signer else ()), *(option for option, wanted in asked.items() if wanted))
    return shlex.join(("worldwright", "stamp", "verify", name, *words))


def _vouch(signature: signing.Signature, command: str) -> str:
    """What a person can do about a world whose signer is not known here; `command` takes anybody's."""
    if signature.holder == "unknown":
        return (
            f"ask whoever sent it for their key's fingerprint; if it is sha256:{signature.fingerprint}: "
            f"`worldwright keys trust sha256:{signature.fingerprint} --name WHO`"
        )
    return f"accept it yourself from its plan, or, if who accepted it does not matter: `{command}`"


def _prove_again(
    live: Run,
    run: Run,
    timeout_s: float,
    progress: Progress,
    signer: Path | None,
    rebuild: bool,
    every: bool,
) -> Verification:
    """`verify`, of a copy (`run`) of what lies in a folder (`live`)."""
    deadline, folder = time.monotonic() + timeout_s, run.stamped
    checks, statement = static(run, folder, signer, live), Kept.read(folder / bundle.STAMP, Statement).value
    if statement is None or not all(c.ok for c in checks):
        return _refuted(run, checks)
    here = _here(folder)
    differences = tuple(another_machine.differences(statement.predicate.environment, statement.predicate.cpu, here))
    vouched = signing.check(folder, bundle.STAMP, signer).vouched
    older = bool(differences) and vouched
    asks = _kept(folder) and not vouched and (rebuild or law_check.concerns(folder))
    rebuild = rebuild and not asks  # it is built again there, beside the kept world and its recorded inputs
    runs = asks or rebuild or not _kept(folder)
    if runs and not vouched and (unconfined := law_check.unconfined()):
        return _refuted(run, [*checks, unconfined], differences)
    with writing("the copy to be run", Path(tempfile.gettempdir())):
        scratch = _scratch(live.stamped, bundle.sha256_file(folder / bundle.STAMP), here, rebuild)
    with writing("the copy to be run", scratch), bundle.only_one(Run(scratch)):
        try:
            if _kept(folder) and not rebuild:
                checks += _facts(folder, older)
                if not checks[-1].ok:
                    return _refuted(run, checks, differences)
            proved = _again(folder, scratch, statement, rebuild, bool(differences), timeout_s, progress)
        except GateError as error:
            shutil.rmtree(scratch / "proof", ignore_errors=True)
            checks.append(Check(name="run", ok=False, detail=str(error)))
            return _refuted(run, checks, differences)
        if proved is None:
            return _running(run, checks, differences)
        checks += _world(folder, statement, proved, differences, rebuild, asks)
        checks += _acts(folder, proved, older)
        mode, found = _motion(folder, statement, proved, differences)
        checks += found
        law: law_check.Law | None = None
        if asks and all(c.ok for c in checks):  # what moves otherwise is refuted, whatever its program says
            law = law_check.check(folder, scratch, statement, proved, differences, deadline, progress)
            if law is None:
                return _running(run, checks, differences)
            checks.append(law.check)
        asked = law.same if law else runs and not asks
        checks += _kinds(statement, proved, asked=asked)
        checks += measured_again.checks(folder, statement, proved, mode == "bitwise")
        if all(c.ok for c in checks):
            audits = trials_again.checks(
                folder,
                scratch,
                proved,
                stamped=statement.predicate.proof.trajectory_sha256,
                exact=not differences,
                vouched=vouched,
                every=every,
                deadline=deadline,
                progress=progress,
            )
            if audits is None:
                return _running(run, checks, differences)
            checks += audits
        if not vouched and all(c.ok for c in checks):  # what moves otherwise is refuted, however it looks
            checks += _pictures(folder, statement, proved)
            checks.append(nobodys_words.told(statement))
    shutil.rmtree(scratch, ignore_errors=True)
    if not all(c.ok for c in checks):
        return _refuted(run, checks, differences, mode)
    return Verification(
        run=run.name, state="proved", mode=mode, checks=tuple(checks), environment_differences=differences
    )


def _again(
    folder: Path,
    scratch: Path,
    statement: Statement,
    rebuild: bool,
    elsewhere: bool,
    timeout_s: float,
    progress: Progress,
) -> Proved | None:
    """Simulate the world again: by its file and its recorded inputs where they are kept, else by its program."""
    program, plan = (folder / "simulation.py").read_bytes(), (folder / "plan.md").read_bytes()
    kept, facts = _kept(folder), folder / bundle.WORLD
    if kept and not rebuild:
        given = lay_out(scratch / "given", folder / WORLD, facts, facts)
        near = beside(folder)
        return replay(scratch / "proof", program, plan, given, timeout_s=timeout_s, progress=progress, near=near)
    return prove(
        scratch / "proof",
        program,
        plan,
        reason=f"stamped as {statement.predicate.run}",
        timeout_s=timeout_s,
        progress=progress,
        near=beside(folder),
        kept=lay_out(scratch / "kept", folder / WORLD, facts) if kept else None,
        elsewhere=elsewhere,
    )


def _facts(folder: Path, older: bool) -> Iterator[Check]:
    """Check the facts beside the kept world against plan and program. `older`: as for `_acts`."""
    kept = folder / bundle.WORLD
    program, plan = folder / "simulation.py", folder / "plan.md"
    found = list(world_facts.differ(folder / WORLD, kept, program, plan, older=older))
    detail = "; ".join(found[:3]) or "of the kept world: as plan and program say"
    yield Check(name="facts", ok=older or not found, detail=detail)


def _kept(folder: Path) -> bool:
    """Whether the world is there as a file, with the inputs that drove it."""
    return (folder / WORLD).is_file() and all((folder / bundle.WORLD / name).is_file() for name in FACTS)


def _world(
    folder: Path, statement: Statement, proved: Proved, differences: tuple[str, ...], rebuild: bool, asks: bool
) -> Iterator[Check]:
    """Check the world that was simulated: the stamped file, or what the stamped program builds here.

    `asks`: the program of the file is run beside it (`law_check`).
    """
    stamped = statement.predicate.proof
    if _kept(folder) and not rebuild:
        driven = "driven again by its recorded inputs" if stamped.inputs_sha256 else "which no input drives"
        yield Check(
            name="world", ok=True, detail=f"its file as stamped, {driven}{'' if asks else ', without its program'}"
        )
        return
    if not stamped.world_sha256:  # an older stamp, of a world that was simulated by its own program
        yield Check(name="world", ok=True, detail="built again by the stamped program")
        return
    if proved.rebuilt:  # compared before it was simulated
        yield Check(name="world", ok=True, detail=f"built again by the stamped program: {proved.rebuilt}")
    else:
        yield _same_hash(stamped, proved, bool(differences))
    if stamped.inputs_sha256:
        same = proved.inputs_sha256 == stamped.inputs_sha256
        detail = f"asked again, the program answers {'the same' if same else 'otherwise'}"
        yield Check(name="inputs", ok=same or bool(differences), detail=detail)


def _same_hash(stamped: Proof, proved: Proved, elsewhere: bool) -> Check:
    """Check a world that its program built against the stamp alone, where its file was not kept."""
    if stamped.content_sha256:
        wanted, got = stamped.content_sha256, proved.content_sha256
    else:
        wanted, got = stamped.world_sha256, proved.world_sha256
    same = wanted == got
    detail = f"built again by the stamped program: {'the same' if same else 'another'}, sha256 {got[:16]}"
    return Check(name="world", ok=same or elsewhere, detail=detail + ("" if same else f" (stamped {wanted[:16]})"))


def _acts(folder: Path, proved: Proved, older: bool) -> Iterator[Check]:
    """Check that the world acts as its plan says. `older`: a known signer stamped it elsewhere, perhaps under other rules."""
    if proved.world is None:
        return
    found = departures.from_plan(proved.world, read_plan(folder / "plan.md").plan)
    detail = "; ".join(found[:3]) or "every pair, joint, mass and law as its plan says"
    yield Check(name="acts", ok=older or not found, detail=detail)


def _locate(name: str) -> Run:
    state = State.find(name)
    run = state.run
    if not run.stamped.is_dir():
        raise NotFoundError(
            f"{state.place} has not been accepted",
            place=str(run.accepted),
            next_move=f"worldwright stamp status {state.place}",
        )
    return run


def _motion(
    folder: Path, statement: Statement, proved: Proved, differences: tuple[str, ...]
) -> tuple[Literal["bitwise", "tolerance"], list[Check]]:
    """Compare the motions; returns the mode and the checks."""
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


def _kinds(statement: Statement, proved: Proved, *, asked: bool) -> Iterator[Check]:
    """Check what the stamp says about the kind of each proof, and tell of which kind it was here (`asked`: the program)."""
    stamped = statement.predicate.proof
    if statement.first:
        yield Check(name="kinds", ok=True, detail="an older stamp, which does not tell how each channel was proved")
        return
    found, marks = exactness.channels(proved, (s.name for s in statement.subject)), exactness.marks(proved)
    same = stamped.channels == found and {*exactness.coded(stamped.marks)} == {*marks}
    exact = proved.trajectory_sha256 == stamped.trajectory_sha256
    told = exactness.told(found, marks, exact=exact, asked=asked)
    detail = told if same else f"the stamp says another kind of proof than there is: {told}"
    yield Check(name="kinds", ok=same, detail=detail)


def _pictures(folder: Path, statement: Statement, proved: Proved) -> Iterator[Check]:
    """Check the stamped pictures against the new recording, where there are any and the same code can draw them."""
    if not any((folder / s.name).is_file() for s in statement.subject if s.name.endswith(redrawn.PICTURES)):
        return
    drawn, here = statement.predicate.environment.film, State(proved.run).film
    if drawn is None or here is None or drawn.sha256 != here.sha256:
        by = f"{drawn.renderer} ({drawn.version})" if drawn else "a film that the stamp does not name"
        yield Check(name="pictures", ok=True, detail=f"NOT compared with this world: drawn by {by}, which is not here")
        return
    found = list(redrawn.differ(folder, statement, proved))
    detail = "; ".join(found[:3]) or "stills, and frames of films by chance, look as when drawn again"
    yield Check(name="pictures", ok=not found, detail=detail)


def _running(run: Run, checks: list[Check], differences: tuple[str, ...]) -> Verification:
    return Verification(run=run.name, state="running", checks=tuple(checks), environment_differences=differences)


def _refuted(
    run: Run, checks: list[Check], differences: tuple[str, ...] = (), mode: Literal["bitwise", "tolerance", ""] = ""
) -> Verification:
    """No yes: something is refuted, or all that fails could not be shown here."""
    left = [c for c in checks if not c.ok]
    shown = not all(c.open for c in left)
    return Verification(
        run=run.name,
        state="refuted" if shown else "not_shown",
        mode=mode,
        checks=tuple(checks),
        environment_differences=differences,
        next_move="restore the accepted folder from version control, or accept the run again"
        if shown
        else left[0].next_move,
    )


def _here(folder: Path) -> Environment:
    used = assets_used.sha256(folder / "plan.md", folder / "simulation.py")
    return environment.current().model_copy(update={"catalog_sha256": used})


def _scratch(folder: Path, stamp_sha256: str, here: Environment, rebuild: bool) -> Path:
    """A private folder that a later call of the same verification finds again and that nobody else could have filled."""
    identity = "\n".join((stamp_sha256, here.sha256(), "rebuilt" * rebuild))
    try:
        return private.proofs(Run(folder), identity)
    except StorageError:  # a user without a writable data folder can still verify
        return Path(tempfile.mkdtemp(prefix="worldwright-"))
