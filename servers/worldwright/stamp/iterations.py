"""The iterations of a run: which is the best so far, when to go back to it, and when repairing has to end.

An iteration is a program that was reviewed. Iterations of one plan and environment are ranked by `scan compare`
(blocking anomalies, then objectives, then margins); of two equal ones the later is the better, since a repair that no
number shows, such as a camera's, is still a repair. When a review orders another repair of a program that is worse than
an earlier one, the earlier program is put back before anybody patches further. After as many ordered repairs as the
approval allows (12 unless it says otherwise) the run is blocked, with the cause, and with its best program in place.
"""

import hashlib
from datetime import UTC, datetime
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_atomic, write_json

from ..model.errors import WorldwrightError
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import SOURCE
from ..model.evidence.verdict import Verdict
from ..model.frozen import Frozen
from ..model.storage import writing
from .kept import Kept
from .state import Blocked, State

if TYPE_CHECKING:
    from ..scan.tools import Comparison

CAP = 12
"""Repairs that may be ordered, unless the approval says otherwise."""
SEEN = ("camera_placement", "visual_mismatch", "missing_object", "scale", "not_recognised", "look")
"""Targets of a repair that is judged by eye: smaller margins alone are no argument against it."""


class RolledBack(Frozen):
    """A repair made the world worse, and the better program was put back."""

    worse: str
    better: str
    why: str


def ordered(state: State) -> tuple[str, ...]:
    """Keys for which a review ordered a repair, since a person last approved a plan."""
    found: dict[str, None] = {}
    for entry in state.journal:
        if entry.get("action") == "approve" and not entry.get("auto"):
            found = {}
        elif entry.get("action") == "review" and entry.get("outcome") == "repair":
            found[str(entry.get("key"))] = None
    return tuple(found)


def cap(state: State) -> int:
    """How many repairs may be ordered."""
    given = [e.get("repairs") for e in state.journal if e.get("action") == "approve"]
    return given[-1] if given and isinstance(given[-1], int) and given[-1] > 0 else CAP


def spent(state: State) -> bool:
    """Whether no repair is left."""
    return len(ordered(state)) >= cap(state)


def best(state: State) -> str:
    """Key of the best reviewed iteration of this plan and environment; empty without any."""
    found = ""
    for key in reviewed(state):
        if not found or _compare(state, found, key).better != "first":
            found = key
    return found


def after_review(state: State, verdict: Verdict) -> RolledBack | None:
    """Put a better program back when the one just reviewed is worse; only when another repair was ordered.

    Call it with a state that knows the review.
    """
    if verdict.outcome != "repair" or state.key is None:
        return None
    here = state.key.key
    found = best(state)
    if not found or found == here:
        return None
    said = _compare(state, found, here)
    if said.better != "first":
        return None
    target = _ordered_target(state, here)
    if getattr(said, "decided_by", "") == "margins" and target in SEEN:
        return None
    why = "; ".join(said.worsened) or "its margins are thinner"
    return RolledBack(worse=here, better=found, why=why) if restore(state, found, why) else None


def restore(state: State, key: str, why: str) -> bool:
    """Put the program of an earlier iteration back, and say so in the journal; False when no true copy was kept."""
    program = _program(state, key)
    if program is None:
        return False
    with writing(state.run.program.name, state.run.folder):
        write_atomic(state.run.program, program)
    state.run.log("stamp", "roll_back", key=key, worse=state.key.key if state.key else "", why=why)
    return True


def end(state: State, verdict: Verdict) -> Blocked | None:
    """Block the run when its repairs are spent: the best program in place, and the cause; None while some are left."""
    if not spent(state):
        return None
    found = best(state) or (state.key.key if state.key else "")
    if state.key is not None and found != state.key.key:
        restore(state, found, "the best iteration is kept where repairing ends")
    now = State(state.run)
    ending = Blocked(
        cause=f"{len(ordered(state))} repairs were ordered (the cap is {cap(state)}) and the world is still not "
        f"right: {_still_wrong(now) or verdict.repair}",
        time=datetime.now(UTC).isoformat(timespec="seconds"),
        program_sha256=now.program_sha256,
        plan_sha256=now.plan_sha256,
        key=now.key.key if now.key else "",
    )
    with writing(now.run.blocked.name, now.run.folder):
        write_json(now.run.blocked, ending.model_dump(mode="json"))
    now.run.log("stamp", "block", cause=ending.cause, key=ending.key)
    return ending


def reviewed(state: State) -> list[str]:
    """Reviewed keys of this plan and environment whose reports and program are here, oldest review first."""
    if state.key is None:
        return []
    found: dict[str, None] = {}
    for entry in state.journal:
        key = str(entry.get("key") or "")
        if entry.get("action") == "review" and key not in found:
            other = Kept.read(state.run.evidence(key) / "key.json", EvidenceKey).value if key else None
            same = other is not None and (other.plan_sha256, other.environment_sha256) == (
                state.key.plan_sha256,
                state.key.environment_sha256,
            )
            reports = all((state.run.evidence(key) / f"{name}.json").is_file() for name in ("scan", "expect"))
            if same and reports and _program(state, key) is not None:
                found[key] = None
    return list(found)


def _program(state: State, key: str) -> bytes | None:
    """The program of an iteration as it was; None when it was not kept, or the copy was changed."""
    folder = state.run.evidence(key)
    named = Kept.read(folder / "key.json", EvidenceKey).value
    try:
        content = Path(folder / SOURCE / state.run.program.name).read_bytes()
    except OSError:
        return None
    return content if named and hashlib.sha256(content).hexdigest() == named.program_sha256 else None


def _compare(state: State, first: str, second: str) -> "Comparison | Any":
    from ..scan.tools import Comparison, compare

    try:
        return compare(str(state.run.folder), first, second)
    except WorldwrightError:  # a report that cannot be read counts neither for nor against an iteration
        return Comparison(better="equal", first=first, second=second)


def _ordered_target(state: State, here: str) -> str:
    """The target of the repair that led to this iteration."""
    reviews = [e for e in state.journal if e.get("action") == "review" and e.get("key") != here]
    return str(reviews[-1].get("target", "")) if reviews else ""


def _still_wrong(state: State) -> str:
    """What the best iteration fails at."""
    scan, expect = state.scan.value, state.expect.value
    wrong = [str(a) for a in scan.anomalies if a.severity == "blocking"] if scan else []
    wrong += (
        [f"{o.claim} is {o.status}" for o in expect.objectives if o.status in ("refuted", "unproved")] if expect else []
    )
    return "; ".join(wrong[:3])
