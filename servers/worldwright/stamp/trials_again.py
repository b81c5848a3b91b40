"""Whether the audits of a stamp are what their repetitions show: one part of them, drawn anew each time, is simulated again.

A report of causes, of a finer step or of worlds a little otherwise rests on repetitions of the physics pass whose recordings
are not kept, and whoever signs has seen only files of them. Which part is made again follows from the stamp and from a number
that is drawn here, so that nobody can forge beside it. With `every`, all of them are. Acceptance itself makes one part again of
those that it rests on, before it signs.
"""

import hashlib
import secrets
from collections.abc import Iterator
from pathlib import Path
from time import monotonic
from typing import Any

from worldkit.files import write_atomic

from ..model.errors import GateError
from ..model.evidence.audits import CausesReport, RefineReport, RobustReport
from ..model.progress import Progress, silent
from . import bundle, law_check
from .as_stamped import Check
from .kept import Kept
from .proof import Proved
from .state import State

Part = Any
"""`scan.audits.repeated.Part`."""
NAME = "audits"
DRAWN = "drawn"


def checks(
    folder: Path,
    scratch: Path,
    proved: Proved,
    *,
    stamped: str,
    exact: bool,
    vouched: bool,
    every: bool,
    deadline: float,
    progress: Progress = silent,
) -> list[Check] | None:
    """The check of the audits of an accepted folder, none where it has no audit; None when it needs longer.

    Args:
        folder: the accepted folder.
        scratch: where a later call of this verification finds what was drawn.
        proved: its world, simulated again; the repetitions are made of it.
        stamped: hash of the recording that the stamp names, of which every audit must be; elsewhere what is proved is another.
        exact: here is the stamped environment, where every repetition must be the same bit for bit. Elsewhere the outcomes must.
        vouched: somebody known here signed the stamp.
        every: all parts, not the one that is drawn.
        deadline: on the monotonic clock, s.
        progress: is told how far it is.
    """
    from ..scan import tools as scan

    inside = folder / "evidence"
    kept: dict[str, Kept[CausesReport] | Kept[RefineReport] | Kept[RobustReport]] = {
        "causes": Kept.read(inside / "causes.json", CausesReport),
        "refine": Kept.read(inside / "refine.json", RefineReport),
        "robust": Kept.read(inside / "robust.json", RobustReport),
    }
    if problem := next((k.problem for k in kept.values() if k.problem), ""):
        return [Check(name=NAME, ok=False, detail=problem)]
    said = {name: k.value for name, k in kept.items() if k.value is not None}
    if not said:
        return []
    if other := [name for name, report in said.items() if report.trajectory_sha256 != stamped]:
        return [Check(name=NAME, ok=False, detail=f"{other[0]}.json is of another recording")]
    if not vouched and law_check.unconfined():
        return [_note(f"{', '.join(said)}: not simulated again, since no sandbox confines their program here")]
    parts = scan.trial_parts(proved.run, proved.recording, said, whole=every)
    if not parts:
        return [_note(f"{', '.join(said)}: the plan names nothing that could be made again")]
    drawn = _drawn(scratch)
    chosen = parts if every else [min(parts, key=lambda part: _place(folder, drawn, part))]
    for part in chosen:
        if not scan.repeat_part(part, scratch / "trials.json", deadline - monotonic(), progress):
            return None
    wrong = list(_wrong(chosen, exact=exact, vouched=vouched))
    names = "; ".join(part.name for part in chosen)
    how = "all of it" if every else f"one of {len(parts)} parts, drawn by {drawn[:16]}; all of them with --every-trial"
    return wrong or [Check(name=NAME, ok=True, detail=f"simulated again and as reported: {names} ({how})")]


def before_signing(
    state: State, proved: Proved, scratch: Path, timeout_s: float, progress: Progress = silent
) -> str | None:
    """Simulate again one part, drawn here, of the audits that a run's claims rest on: causes, and a finer step where it was asked for.

    Args:
        state: the run.
        proved: its world, simulated again; the repetitions are made of it.
        scratch: a folder of nobody else's, where a later call of this acceptance finds what was drawn.
        timeout_s: s.
        progress: is told how far it is.

    Returns:
        The name of the part, empty where there is none; None when it needs longer.

    Raises:
        GateError: the report says otherwise, or the part could not be simulated.
    """
    from ..scan import tools as scan

    given = {"causes": state.causes.value, "refine": state.refine.value}
    said = {name: report for name, report in given.items() if report is not None}
    parts = scan.trial_parts(proved.run, proved.recording, said, whole=False) if said else []
    if not parts:
        return ""
    drawn = _drawn(scratch)
    part = min(parts, key=lambda part: hashlib.sha256(f"{drawn}\n{part.name}".encode()).hexdigest())
    if not scan.repeat_part(part, scratch / "trials.json", timeout_s, progress):
        return None
    differs, unmade = scan.unlike_part(part, exact=True)
    name = part.name.partition(":")[0]
    report = f"{state.folder}/{name}.json"
    if differs:
        raise GateError(
            f"simulated again, the audit does not say what it shows: {part.name}: {differs}",
            place=report,
            next_move=f"rm {report} && worldwright scan scan {state.place} --{name}",
        )
    if unmade:
        raise GateError(
            f"a part of the audits could not be simulated again: {part.name}: {unmade}",
            place=report,
            next_move=f"give the machine the room that it lacks, then worldwright stamp accept {state.place}",
        )
    return str(part.name)


def _wrong(chosen: list[Part], *, exact: bool, vouched: bool) -> Iterator[Check]:
    """A check for each part that says otherwise, or that could not be made here."""
    from ..scan import tools as scan

    for part in chosen:
        differs, unmade = scan.unlike_part(part, exact=exact)
        if not differs and not unmade:
            continue
        told = f"{part.name}: {differs or f'could not be simulated here: {unmade}'}"
        if exact and differs:
            yield Check(name=NAME, ok=False, detail=told)
        elif vouched:
            yield _note(told + ("" if unmade else ", in another environment than the stamped"))
        else:  # whoever wrote the stamp also wrote where it was stamped
            move = "verify it where it was stamped, or with more room"
            yield Check(name=NAME, ok=False, open=True, detail=told, next_move=move)


def _note(detail: str) -> Check:
    return Check(name=NAME, ok=True, note=True, detail=detail)


def _drawn(scratch: Path) -> str:
    """What was drawn for this verification, which may take several calls."""
    path = scratch / DRAWN
    if not path.is_file():
        write_atomic(path, secrets.token_hex(16))
    return path.read_text(encoding="utf-8")


def _place(folder: Path, drawn: str, part: Part) -> str:
    words = "\n".join((bundle.sha256_file(folder / bundle.STAMP), drawn, part.name))
    return hashlib.sha256(words.encode()).hexdigest()
