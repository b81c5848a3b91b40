"""Accepting: strip, prove, assemble, publish. Nothing appears under `accepted/` before all of it is on disk."""

import hashlib
import shutil
import tempfile
import time
from collections import Counter
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING

from worldkit.files import write_atomic

from ..model.errors import GateError
from ..model.evidence import came, handed_in, pictures_of
from ..model.evidence.reports import Environment
from ..model.plan.committed import Plan
from ..model.progress import Progress, silent
from ..model.storage import writing
from . import (
    bundle,
    departures,
    digest,
    drawn_by_program,
    driven_live,
    exactness,
    gates,
    judged,
    keyring,
    poster,
    private,
    private_copy,
    processor,
    proof_told,
    redrawn,
    repeats,
    sampled,
    sealed,
    signing,
    trials_again,
    versions,
    world_facts,
)
from .accepted import Accepted
from .judged import Judged
from .proof import WORLD, Proved, driven_by, prove
from .state import State
from .statement import (
    Acceptance,
    Approval,
    Digest,
    ExpectationVerdict,
    Filmed,
    ObjectiveOutcome,
    Proof,
    Source,
    Statement,
)
from .steps import handed_in_since, steps
from .strip import Stripped, strip
from .taken import Taken, take

if TYPE_CHECKING:
    from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PrivateKey


def accept(state: State, timeout_s: float, progress: Progress = silent, key: Path | None = None) -> Accepted:
    """Accept the run, or say (as a `GateError`) why not; callable again after `proving` or a crash.

    The stamp is signed with `key`, an Ed25519 private key, or with this machine's own. A stamp that stands already
    counts only if a key that is known here signed it; otherwise the world is proved again, since a stamp that was merely
    found proves nothing.
    """
    deadline = time.monotonic() + timeout_s
    signer = signing.private_key(key) if key else keyring.own()
    with writing("the accepted folder", state.run.folder), bundle.only_one(state.run):
        taken = take(state.run)
        listed = not handed_in_since(state)
        if listed and steps(state)["accept"].holds and signing.check(state.run.stamped, bundle.STAMP).vouched:
            if key is not None:
                _signed_anew(state, signer)
            return _again(state)
        shown = judged.take(state)
        gates.pass_through("accept", state)
        taken.still(state.run)  # what the gates saw
        shown.still(state)
        handed_in.of(state.run.folder)
        stripped = strip((state.program_bytes or b"").decode(), f"{state.place}/simulation.py")
        program, plan = stripped.source.encode(), state.plan_bytes or b""
        work = private.proofs(state.run, state.key.key if state.key else "")
        kept = repeats.laid_out(state, work / "kept")
        if kept:
            _factual(state, stripped, kept)
        proved = prove(
            work / "proof",
            program,
            plan,
            reason=f"copied from {state.run.name}",
            timeout_s=timeout_s,
            progress=progress,
            near=taken.near,
            kept=kept,
        )
        if proved is None:
            return _proving(state, work, "proof")
        if proved.world:
            _factual(state, stripped, proved.world.parent)
        repeats.same(state, stripped, proved)
        repeats.whole(state, proved)
        _as_planned(state, proved)
        driven_live.declared(state.run, state.plan.declared() if state.plan else (), proved)
        repeats.measured(state, proved)
        left = max(1.0, deadline - time.monotonic())
        driven = repeats.driven_again(work / "again", program, plan, proved, timeout_s=left, progress=progress)
        left = max(1.0, deadline - time.monotonic())
        again = None if driven is None else trials_again.before_signing(state, proved, work, left, progress)
        if again is None:
            return _proving(state, work, "again" if driven is None else "audit")
        made = work / "accepted"  # what is signed lies where nobody else writes, until it is signed
        try:
            shutil.rmtree(made, ignore_errors=True)
            statement = _assemble(state, stripped, proved, again, taken, shown, made, signer)
            _look(state, proved, made, statement.predicate.film)
            stamp_sha256 = bundle.seal(made, statement)
            signing.sign(made, bundle.STAMP, signer)
            bundle.publish_copy(made, state.run, versions.aside(state.run))
        finally:
            shutil.rmtree(made, ignore_errors=True)
        _log(state, stamp_sha256, proof_began=proved.began, proof_earlier=proved.earlier)
        state.run.blocked.unlink(missing_ok=True)
        shutil.rmtree(work, ignore_errors=True)
    return _answer(state, statement, stamp_sha256)


def _proving(state: State, work: Path, part: proof_told.Part) -> Accepted:
    """The answer while it is proved; it goes on by itself."""
    told = proof_told.line(state, work, part)
    return Accepted(
        state="proving", run=state.run.name, under_way=told, next_move=f"worldwright stamp accept {state.place}"
    )


def _signed_anew(state: State, signer: "Ed25519PrivateKey") -> None:
    """Sign the stamp that stands with another key: of a copy that nobody else can change, so that it is the vouched one."""
    with private_copy.of(state.run) as copy:
        if not signing.check(copy.stamped, bundle.STAMP).vouched:
            raise GateError("the accepted folder changed meanwhile", place=state.place, next_move="accept it again")
        signing.sign(copy.stamped, bundle.STAMP, signer)
        for name in (signing.PUBLIC, signing.ENVELOPE):
            write_atomic(state.run.stamped / name, (copy.stamped / name).read_bytes())


def _as_planned(state: State, proved: Proved) -> None:
    """Refuse a world that acts otherwise than its plan says (`GateError`)."""
    if proved.world is None or state.plan is None:
        return
    if found := departures.from_plan(proved.world, state.plan):
        more = f" (and {len(found) - 1} more)" if len(found) > 1 else ""
        raise GateError(
            f"the world that was simulated is not the planned one: {found[0]}{more}",
            place=f"{state.place}/simulation.py",
            next_move=f"worldwright lint check-program {state.place}/simulation.py --plan {state.place}/plan.md",
        )


def _assemble(
    state: State,
    stripped: Stripped,
    proved: Proved,
    again: str,
    taken: Taken,
    shown: Judged,
    folder: Path,
    signer: "Ed25519PrivateKey",
) -> Statement:
    """Fill a private folder and say what is in it."""
    taken.lay(folder)
    write_atomic(folder / "simulation.py", stripped.source.encode())
    write_atomic(folder / "plan.md", state.plan_bytes or b"")
    write_atomic(folder / digest.NAME, digest.motion(proved.recording).model_dump_json() + "\n")
    sampled.write(proved.recording, folder / sampled.NAME)
    if proved.world is not None:
        write_atomic(folder / proved.world.name, proved.world.read_bytes())
        for path in driven_by(proved):
            write_atomic(folder / bundle.WORLD / path.name, path.read_bytes())
    evidence = {}
    for name, path in shown.files.items():
        content = shown.content(state, name)
        write_atomic(folder / name, content)
        if path.suffix == ".json":
            evidence[str(path.relative_to(state.folder))] = Digest(sha256=hashlib.sha256(content).hexdigest())
    filmed = _filmed(state, taken)
    cameras = [camera.name for camera in state.plan.cameras()] if state.plan else []
    poster.write(folder, cameras, filmed.shots if filmed else ())
    predicate = _predicate(state, stripped, proved, taken, shown, evidence, folder)
    seals = sealed.told(shown.journal, [signer.public_key(), *sealed.known()])
    proof = predicate.proof.model_copy(update={"simulated_again": (again,) if again else ()})
    predicate = predicate.model_copy(update={"journal_seal": seals, "proof": proof})
    return Statement(subject=bundle.subjects(folder), predicate=predicate)


def _look(state: State, proved: Proved, folder: Path, filmed: Filmed | None = None) -> None:
    """Refuse pictures that show another world, and a film that is told otherwise than it is (`GateError`): that they are as their
    pass wrote them, and its result, says a journal without secrets."""
    for found in redrawn.glance(folder, proved, filmed=filmed):
        stage = "video" if ".mp4" in found.split()[0] else "stills"
        raise GateError(
            found,
            place=str(state.folder / stage),
            next_move=f"rm -r {state.folder / stage} && worldwright stage start {state.place} --stage {stage}",
        )


def _factual(state: State, stripped: Stripped, facts: Path) -> None:
    """Refuse facts of a world, in its folder, that are not those of plan and program (`GateError`): verification would, too."""
    with tempfile.TemporaryDirectory(prefix="worldwright-") as folder:
        program = Path(folder) / "simulation.py"
        write_atomic(program, stripped.source.encode())
        plan = Path(folder) / "plan.md"  # the one that is accepted, whatever the run's file says by then
        write_atomic(plan, state.plan_bytes or b"")
        for found in world_facts.differ(facts / WORLD, facts, program, plan):
            raise GateError(
                f"the program calls `program.main` otherwise than its text says: {found}",
                place=f"{state.place}/simulation.py",
                next_move="write plain values there, or names that are bound once",
            )


def _proof(proved: Proved, shown: Judged) -> Proof:
    """What the proof run was, and of which kind it proves each channel."""
    return Proof(
        trajectory_sha256=proved.trajectory_sha256,
        rows=proved.physics.summary.get("rows"),
        simulated_s=proved.physics.summary.get("final_time"),
        wall_s=proved.physics.wall_s,
        began=proved.began,
        key=proved.key,
        earlier=proved.earlier,
        sandbox=proved.physics.sandbox,
        confinement=proved.physics.confinement,
        world_sha256=proved.world_sha256,
        content_sha256=proved.content_sha256,
        inputs_sha256=proved.inputs_sha256,
        channels=exactness.channels(proved, shown.files),
        marks=exactness.marks(proved),
    )


def _predicate(
    state: State,
    stripped: Stripped,
    proved: Proved,
    taken: Taken,
    shown: Judged,
    evidence: dict[str, Digest],
    folder: Path,
) -> Acceptance:
    from .. import __version__

    plan, key, environment = state.plan, state.key, state.environment
    scan, expect, review, visual = state.scan.value, state.expect.value, state.review.value, state.visual.value
    if not (plan and key and environment and scan and expect and review and visual):
        needed: dict[str, object] = {
            "plan.md": plan,
            "simulation.py": key,
            "the environment": environment,
            "scan.json": scan,
        }
        needed |= {"expect.json": expect, "review.json": review, "visual.json": visual}
        gone = ", ".join(name for name, found in needed.items() if not found)
        raise GateError(
            f"the run changed while it was being accepted: {gone} cannot be read any more",
            place=state.place,
            next_move=f"worldwright stamp status {state.place}",
        )
    bound = {o.index: o.evidence for o in review.objectives}
    approval = state.approval or {}
    return Acceptance(
        run=state.run.name,
        accepted_at=datetime.now(UTC).isoformat(timespec="seconds"),
        worldwright=__version__,
        source=Source(
            key=key.key,
            program_sha256=key.program_sha256,
            plan_sha256=key.plan_sha256,
            prompt_sha256="" if taken.prompt is None else hashlib.sha256(taken.prompt).hexdigest(),
            stripped_lines=stripped.removed,
            materials=_materials(state, taken, shown, environment),
        ),
        proof=_proof(proved, shown),
        film=_filmed(state, taken),
        drawn_only=_drawn_only(proved, plan),
        handed_in=handed_in.of(folder),
        environment=environment.model_copy(update={"film": state.film}),
        cpu=processor.cpu(),
        evidence=evidence,
        checks=sum(c.status != "skipped" for c in scan.checks),
        anomalies=dict(Counter(a.severity for a in scan.anomalies)),
        objectives=tuple(
            ObjectiveOutcome(
                index=o.index,
                claim=o.claim,
                status=o.status,
                evidence=bound.get(o.index, ()),
                looked_at=visual.looked if o.status == "visual_only" else None,
            )
            for o in expect.objectives
        ),
        expectations=tuple(
            ExpectationVerdict(
                objective=o.index, name=e.name, status=e.status, measured=e.measured, margin=e.margin, unit=e.unit
            )
            for o in expect.objectives
            for e in o.expectations
        ),
        declared_interventions=driven_live.declared(state.run, plan.declared(), proved),
        journal_head=shown.journal.head(),
        reviewer=review.reviewer,
        review_came=state.came("review"),
        described_by=visual.author,
        description_came=state.came("describe"),
        approval=Approval(
            by=str(approval.get("by", "")),
            time=str(approval.get("time", "")),
            auto=bool(approval.get("auto")),
            came=came.of(approval),
        ),
    )


def _drawn_only(proved: Proved, plan: Plan) -> tuple[str, ...]:
    """What the program draws, and neither it nor the plan has simulated."""
    from worldengine.recording import stored

    return drawn_by_program.listed(stored.open(proved.recording).meta, plan)


def _filmed(state: State, taken: Taken) -> Filmed | None:
    """The author's film, and what the video pass says of it; None where there is none."""
    video, sha256 = state.passes["video"].value, taken.film_sha256
    told = (video.summary.get("film") or {}) if video and video.ok else {}
    if not sha256:
        return None
    return Filmed(**{name: told[name] for name in Filmed.model_fields if name in told} | {"sha256": sha256})


def _materials(state: State, taken: Taken, shown: Judged, environment: Environment) -> dict[str, Digest]:
    """What the world was made from, by name: the run's own files, the engine, the code, its assets and the film."""
    reference = [p for p in state.run.folder.glob("reference.*") if p.is_file()]
    found = {path.name: Digest(sha256=bundle.sha256_file(path)) for path in reference}
    bytes_of = {
        state.run.journal.name: shown.journal.held,
        state.run.program.name: state.program_bytes,
        state.run.plan.name: state.plan_bytes,
    }
    bytes_of |= {state.run.prompt.name: taken.prompt, pictures_of.FILM: taken.film.get(pictures_of.FILM)}
    found |= {
        name: Digest(sha256=hashlib.sha256(held).hexdigest()) for name, held in bytes_of.items() if held is not None
    }
    made = {name: getattr(environment, f"{name}_sha256") for name in ("simulator", "worldkit", "catalog")}
    made["film"] = state.film.sha256 if state.film else ""
    return found | {name: Digest(sha256=sha256) for name, sha256 in made.items() if sha256}


def _again(state: State) -> Accepted:
    """The earlier acceptance of this exact program and plan; its journal entry is added if a crash ate it."""
    stamp_sha256 = bundle.sha256_file(state.run.stamped / bundle.STAMP)
    if not any(e.get("action") == "accept" and e.get("stamp_sha256") == stamp_sha256 for e in state.journal):
        _log(state, stamp_sha256)
    if state.stamp.value is None:  # it held a moment ago
        raise GateError("the accepted folder changed meanwhile", place=state.place, next_move="accept it again")
    return _answer(state, state.stamp.value, stamp_sha256, already=True)


def _log(state: State, stamp_sha256: str, **proof: object) -> None:
    state.run.log("stamp", "accept", key=state.key.key if state.key else "", stamp_sha256=stamp_sha256, **proof)


def _answer(state: State, statement: Statement, stamp_sha256: str, already: bool = False) -> Accepted:
    proof = statement.predicate.proof
    return Accepted(
        state="accepted",
        run=state.run.name,
        folder=state.place if state.run.stamped == state.run.folder else f"{state.place}/accepted",
        stamp_sha256=stamp_sha256,
        signature=signing.check(state.run.stamped, bundle.STAMP),
        trajectory_sha256=proof.trajectory_sha256,
        proof_earlier=already or proof.earlier,
        proof_began=proof.began,
        proof_key=proof.key,
        stripped_lines=len(statement.predicate.source.stripped_lines),
        files=tuple(s.name for s in statement.subject),
        already=already,
        not_looked_at=statement.not_looked_at,
        next_move=f"worldwright stamp verify {state.place}",
    )
