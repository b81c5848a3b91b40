"""The tools of the stamp server."""

from contextlib import suppress
from pathlib import Path
from typing import Annotated

from pydantic import Field

from ..expose import reads
from ..model import call_time
from ..model.errors import WorldwrightError
from ..model.evidence.build_steps import StepName
from ..model.evidence.reports import EvidenceKey, VisualDescription
from ..model.evidence.verdict import Verdict
from ..model.frozen import Frozen
from ..model.progress import Progress, silent
from .accepted import Accepted
from .gone import Gone
from .state import Blocked, State
from .status import Status
from .steps import one
from .verification import Verification

RunName = Annotated[str, Field(description="The run folder, or its name")]
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

    Derived from the files each time, damaged ones too: every step, why it does not hold, and the one command to run
    next. Evidence of earlier programs or plans never counts.
    """
    from .status import status as derive

    return derive(State.find(run))


def go(
    run: RunName,
    refine: Annotated[bool, Field(description="Also repeat the physics at half the time step")] = False,
    until: Annotated[
        StepName | None, Field(description="End after this step's group: `expect` draws no film yet")
    ] = None,
    timeout_s: Timeout = 40.0,
    memory_mb: Annotated[int, Field(description="Resident memory limit of each pass", ge=64)] = 4096,
    progress: Progress = silent,
) -> Gone:
    """Advance a run as far as it goes without a decision: check, place, draft, lint, physics, scan, expect, audits, film.

    Tells all that is wrong together, what to mend first in front. Never repeats what holds. `running`: call again.
    """
    from .going import Going

    return Going(
        State.find(run).run, timeout_s=call_time.waiting_s(timeout_s), refine=refine, until=until, progress=progress,
        memory_mb=memory_mb,
    ).go()  # fmt: skip


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
    from ..model.evidence import approval
    from . import gates, keyring

    state = State.find(run)
    gates.pass_through("approve", state)
    if auto:
        gates.pass_through("auto_approve", state)
    facts: dict[str, object] = {"models": state.model_hashes} if state.model_hashes else {}
    facts["came"] = _came()
    who = approval.who(by, auto=auto)
    with suppress(WorldwrightError):  # made on first use, so that the journal is sealed from here on
        keyring.own()
    state.run.log(who, "approve", plan_sha256=state.plan_sha256, by=who, auto=auto, repairs=repairs, **facts)
    what = "".join(f", with {name}" for name in state.model_hashes)
    return _recorded(run, f"plan {state.plan_sha256[:16]} approved {approval.told(by, auto=auto)}{what}")


def describe(
    run: RunName, description: Annotated[VisualDescription, Field(description="What is seen; no verdict")]
) -> Recorded:
    """Keep a description of what the stills and videos of this key show.

    Describes and never judges: what each camera shows, each object, what bears on each objective, concerns. Needs
    stills or video of the current program and plan (look at them with `stage frames`). Every camera that was pictured
    and at least one object are described, by names that exist, with at least one observation each.
    """
    from . import descriptions, gates
    from .refusal import raise_if

    state = State.find(run)
    gates.pass_through("describe", state)
    raise_if("describe", descriptions.problems(state, description), state.place)
    again = (state.run.evidence(_key(state)) / "visual.json").is_file()
    path = state.run.keep(_key(state), "visual", description)
    state.run.log(description.author, "describe", key=_key(state).key, came=_came(), **_of_film(state))
    what = f"described by {description.author}" + (", in place of an earlier description" if again else "")
    # No next move: it would tell the witness what the numbers say, and the next description would know.
    return Recorded(run=state.run.name, what=what, file=str(path.relative_to(state.run.folder)))


def review(run: RunName, verdict: Annotated[Verdict, Field(description="Three channels, one verdict")]) -> Recorded:
    """Keep a typed verdict on this key: pass, repair (one target, one patch) or blocked.

    Needs scan, expectations and visual description of the current key. Judge every objective once and bind it to
    evidence that exists: `expect:<name>`, `scan:clean`, `visual:<camera or object>`, `still:<camera>`,
    `video:<camera>`, `physics:<fact>`. A pass is refused while an objective is refuted or unproved or an anomaly
    blocks; a repair needs a cross check in another channel. A program worse than an earlier one is put back; when no
    repair is left, the run is blocked.
    """
    from . import bindings, gates, iterations
    from .refusal import raise_if

    state = State.find(run)
    gates.pass_through("review", state)
    raise_if("review", bindings.problems(state, verdict), state.place)
    path = state.run.keep(_key(state), "review", verdict)
    target = {"target": verdict.repair_target} if verdict.repair_target else {}
    state.run.log(
        verdict.reviewer,
        "review",
        key=_key(state).key,
        outcome=verdict.outcome,
        came=_came(),
        **_of_film(state),
        **target,
    )
    what = f"{verdict.outcome}, by {verdict.reviewer}"
    known = State(state.run)
    if verdict.outcome == "repair" and (ending := iterations.end(known, verdict)):
        what += f"; blocked: {ending.cause}"
    elif back := iterations.after_review(known, verdict):
        what += f"; worse than {back.better}, whose program is put back: {back.why}"
    if verdict.outcome == "pass" and (film := one(known, "video")).status not in ("holds", "not_needed"):
        what += f"; acceptance needs the films, too ({film.detail or film.status}): `worldwright go {known.place}`"
    return _recorded(run, what, str(path.relative_to(state.run.folder)))


def accept(
    run: RunName,
    timeout_s: Timeout = 40.0,
    signing_key: Annotated[
        Path | None, Field(description="Ed25519 private key (PEM or OpenSSH) to sign with; this machine's without it")
    ] = None,
    progress: Progress = silent,
) -> Accepted:
    """Stamp the world: strip instrumentation, lint and run it once more, write `accepted/` whole.

    Needs a passing review, an approved plan, no blocking anomaly and no undeclared intervention. The stripped program
    must move the same in a fresh run, which is measured anew. `proving`: call again.
    """
    from .acceptance import accept as take

    return take(State.find(run), call_time.waiting_s(timeout_s), progress, signing_key)


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
    anybody: Annotated[bool, Field(description="A yes also when nobody known here signed it")] = False,
    rebuild: Annotated[bool, Field(description="Run the program, also where its world is kept as a file")] = False,
    every_trial: Annotated[
        bool, Field(description="Simulate all repetitions of its audits again, not a drawn part")
    ] = False,
    progress: Progress = silent,
) -> Verification:
    """Prove an accepted world again: every checksum, then the world simulated anew, in the sandbox.

    A world kept as a file is driven by its recorded inputs, which its program must send again if nobody known here signed;
    where none is kept (a small form, over 250 kB), or with `rebuild`, its program builds it again. Who signed is said first; it
    is no yes while nobody known here did. One part of its audits, drawn by chance, is simulated again, too. Exact on the
    same build and processor, elsewhere within a tolerance. `running`: call again.
    """
    from .verification import verify as prove_again

    return prove_again(run, call_time.waiting_s(timeout_s), progress, signer, anybody, rebuild, every_trial)


def _came() -> dict[str, object]:
    """How the word came that is being taken down."""
    from ..model.evidence import came

    return came.current().model_dump(mode="json", exclude_defaults=True)


def _of_film(state: State) -> dict[str, str]:
    """Which pictures a word is about: those of a film made otherwise are others."""
    return {"film_sha256": state.pictures("video")} if state.film else {}


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


TOOLS = (status, go, approve, describe, review, accept, block, verify)
