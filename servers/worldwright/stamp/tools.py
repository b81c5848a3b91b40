"""The tools of the stamp server."""

from pathlib import Path
from typing import Annotated

from pydantic import Field

from ..expose import reads
from ..model.evidence import EvidenceKey, VisualDescription
from ..model.frozen import Frozen
from ..model.progress import Progress, silent
from ..model.verdict import Verdict
from .acceptance import Accepted
from .state import Blocked, State
from .status import Status
from .verification import Verification

RunName = Annotated[str, Field(description="Path of the run folder, or its slug under runs/ or examples/")]
Timeout = Annotated[float, Field(description="Seconds this call may take; the work goes on, call again", gt=0)]


class Recorded(Frozen):
    """Something was taken into the run's records."""

    run: str
    what: str
    file: str = ""
    """Relative to the run folder."""
    next_move: str = ""

    def text(self) -> str:
        """One line, and the next command."""
        where = f" ({self.file})" if self.file else ""
        return f"{self.run}: {self.what}{where}" + (f"\n  next: {self.next_move}" if self.next_move else "")


@reads
def status(run: RunName) -> Status:
    """What has been proven so far for this exact program, plan and environment, and is it enough?

    Derived from the files of the run folder each time. Lists every step from `planned` to `accepted`, why each one does
    not hold, and the one command to run next. Evidence of earlier programs or plans never counts. Works on damaged and
    half-written folders.
    """
    from .status import status as derive

    return derive(State.find(run))


def approve(
    run: RunName,
    by: Annotated[str, Field(description="Who read the plan")] = "user",
    auto: Annotated[bool, Field(description="Nobody read it: require every inferred value to be marked")] = False,
    repairs: Annotated[int, Field(description="Repairs that may be ordered before the run is blocked", ge=1)] = 12,
) -> Recorded:
    """Approve the plan as it stands; code may be written and run against exactly these bytes.

    The model files beside it that its mjcf and urdf rows name are approved with it: one that changes needs a new approval.

    Needs a plan that reads, lints without error and leaves nothing TO_CLARIFY. Use `by=user` only for a person's own
    word; in auto mode, values that neither the prompt nor a source states must be listed in `inferred`.
    """
    from . import gates

    state = State.find(run)
    gates.pass_through("approve", state)
    if auto:
        gates.pass_through("auto_approve", state)
    facts = {"models": state.model_hashes} if state.model_hashes else {}
    state.run.log(by, "approve", plan_sha256=state.plan_sha256, by=by, auto=auto, repairs=repairs, **facts)
    what = "".join(f", with {name}" for name in state.model_hashes) + (" in auto mode" if auto else "")
    return _recorded(run, f"plan {state.plan_sha256[:16]} approved by {by}{what}")


def describe(
    run: RunName, description: Annotated[VisualDescription, Field(description="What is seen; no verdict")]
) -> Recorded:
    """Keep a description of what the stills and videos of this key show.

    Describes and never judges: what each camera shows, each object, what bears on each objective, concerns. Needs
    stills or video of the current program and plan (look at them with `stage frames`).
    """
    from . import gates

    state = State.find(run)
    gates.pass_through("describe", state)
    again = (state.run.evidence(_key(state)) / "visual.json").is_file()
    path = state.run.keep(_key(state), "visual", description)
    state.run.log(description.author, "describe", key=_key(state).key)
    what = f"described by {description.author}" + (", in place of an earlier description" if again else "")
    # No next move: it would tell the witness what the numbers say, and the next description would know.
    return Recorded(run=state.run.name, what=what, file=str(path.relative_to(state.run.folder)))


def review(run: RunName, verdict: Annotated[Verdict, Field(description="Three channels, one verdict")]) -> Recorded:
    """Keep a typed verdict on this key: pass, repair (one target, one patch) or blocked.

    Needs scan, expectations and visual description of the current key. Judge every objective once and bind it to
    evidence that exists: `expect:<name>`, `scan:clean`, `visual:<camera or object>`, `still:<camera>`,
    `video:<camera>`, `physics:<fact>`. A pass is refused while an objective is refuted or unproved or an anomaly
    blocks; a repair needs a cross check in another channel. When a repair is ordered of a program that is worse than an
    earlier one (`scan compare`), the earlier one is put back; when no repair is left, the run is blocked.
    """
    from . import bindings, gates, iterations
    from .refusal import raise_if

    state = State.find(run)
    gates.pass_through("review", state)
    raise_if("review", bindings.problems(state, verdict), state.place)
    path = state.run.keep(_key(state), "review", verdict)
    target = {"target": verdict.repair_target} if verdict.repair_target else {}
    state.run.log(verdict.reviewer, "review", key=_key(state).key, outcome=verdict.outcome, **target)
    what = f"{verdict.outcome}, by {verdict.reviewer}"
    known = State(state.run)
    if verdict.outcome == "repair" and (ending := iterations.end(known, verdict)):
        what += f"; blocked: {ending.cause}"
    elif back := iterations.after_review(known, verdict):
        what += f"; worse than {back.better}, whose program is put back: {back.why}"
    return _recorded(run, what, str(path.relative_to(state.run.folder)))


def accept(
    run: RunName,
    timeout_s: Timeout = 40.0,
    signing_key: Annotated[
        Path | None, Field(description="Ed25519 private key (PEM or OpenSSH) to sign the stamp with")
    ] = None,
    progress: Progress = silent,
) -> Accepted:
    """Stamp the world: strip instrumentation, lint and run it once more, write `accepted/` whole.

    Needs a passing review of this key, an approved and unchanged plan, no blocking anomaly and no undeclared
    intervention. The stripped program must give the same trajectory hash in a fresh sandboxed run. The folder
    holds program, plan, films, trajectory and the world as one file that plain MuJoCo opens. Returns state `proving` when that run takes longer than this call: call again.
    """
    from .acceptance import accept as take

    return take(State.find(run), timeout_s, progress, signing_key)


def block(
    run: RunName, cause: Annotated[str, Field(description="Why no world can come of it", min_length=3)]
) -> Recorded:
    """End the run without a world, naming the cause; it reopens when the plan or the program changes.

    Refused for an accepted program and plan. Use it when repairs stop helping, or when the request cannot be met.
    """
    from datetime import UTC, datetime

    from worldkit.files import write_json

    from ..model.storage import writing
    from . import gates

    state = State.find(run)
    gates.pass_through("block", state)
    ending = Blocked(
        cause=cause,
        time=datetime.now(UTC).isoformat(timespec="seconds"),
        program_sha256=state.program_sha256,
        plan_sha256=state.plan_sha256,
        key=state.key.key if state.key else "",
    )
    with writing(state.run.blocked.name, state.run.folder):
        write_json(state.run.blocked, ending.model_dump(mode="json"))
    state.run.log("stamp", "block", cause=cause, key=ending.key)
    return _recorded(run, f"blocked: {cause}", state.run.blocked.name)


@reads
def verify(
    run: RunName,
    timeout_s: Timeout = 40.0,
    signer: Annotated[Path | None, Field(description="Public key that must have signed the stamp")] = None,
    progress: Progress = silent,
) -> Verification:
    """Prove an accepted world again: every checksum, then a fresh sandboxed run of the accepted program.

    The same build and processor family must repeat the trajectory bit for bit; another one must stay within a stated
    tolerance with identical expectation verdicts, and what differs is named. Reads `accepted/`, never writes it. Takes
    a run folder or an accepted folder. Returns state `running` when it needs longer than this call: call again.
    """
    from .verification import verify as prove_again

    return prove_again(run, timeout_s, progress, signer)


def _key(state: State) -> EvidenceKey:
    from ..model.errors import GateError

    if state.key is None:
        raise GateError(
            "there is no evidence key: plan, program or environment cannot be read",
            place=state.place,
            next_move=f"worldwright stamp status {state.place}",
        )
    return state.key


def _recorded(run: str, what: str, file: str = "") -> Recorded:
    """The answer, with the next command derived from the files as they are now."""
    now = status(run)
    return Recorded(run=now.run, what=what, file=file, next_move=now.next_move)


TOOLS = (status, approve, describe, review, accept, block, verify)
