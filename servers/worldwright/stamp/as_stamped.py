"""Checking an accepted folder without running anything: bytes, plan and prompt, journal, signature, the plan beside it."""

from collections.abc import Iterator
from pathlib import Path

from ..model.evidence.journal import Journal
from ..model.evidence.run import Run
from ..model.frozen import Frozen
from . import bundle, lies_beside, sealed, signing
from .kept import Kept
from .state import State
from .statement import Statement


class Check(Frozen):
    """One thing that was checked."""

    name: str
    ok: bool
    detail: str
    open: bool = False
    """Not `ok`, and not refuted either: it cannot be shown here."""
    note: bool = False
    """Nothing was checked: it tells what no check speaks of."""
    next_move: str = ""


def static(run: Run, folder: Path, signer: Path | None = None, live: Run | None = None) -> list[Check]:
    """The checks of an accepted folder that need no simulation; `live`: the run that `run` is a private copy of."""
    kept = Kept.read(folder / bundle.STAMP, Statement)
    if kept.value is None:
        return [Check(name="stamp", ok=False, detail=kept.problem or "there is no stamp.json")]
    signed = signing.check(folder, bundle.STAMP, signer)
    return [
        *_static(run, folder, kept.value),
        Check(name="signature", ok=signed.holder != "broken", detail=signed.text()),
        *_beside(run, folder, kept.value, live or run),
    ]


def _beside(run: Run, folder: Path, statement: Statement, live: Run) -> Iterator[Check]:
    """Check that the plan beside an accepted folder is the stamped one: a genuine stamp proves nothing about another plan, and
    none about what is reached by a link, which is whoever's it leads to.

    A plan or a journal that is missing lies about nothing, and is told. What else lies beside what was stamped is told by its
    name, by a look at the run itself: no answer rests on it.
    """
    if unlisted := bundle.beside_small(folder, statement):
        yield Check(
            name="beside", ok=True, note=True, detail=f"{_some(unlisted)}: in no list, this stamp says nothing of it"
        )
    if folder == run.folder:
        return
    for path in (run.plan, run.journal):
        if path.is_symlink():
            detail = f"{path.name} of the run is a link: what it leads to is not the run's, and this stamp says nothing of it"
            yield Check(name="beside", ok=False, detail=detail)
    held = (run.plan, *[run.journal] * bool(statement.predicate.journal_head))
    if missing := [path.name for path in held if not path.is_file() and not path.is_symlink()]:
        detail = f"{' and '.join(missing)} of the run: not there, only {folder.name}/ is"
        yield Check(name="beside", ok=True, note=True, detail=detail)
    if run.plan.is_file() and run.plan.read_bytes() != (folder / run.plan.name).read_bytes():
        detail = (
            f"the plan of the run is another than the stamped one in {folder.name}/, which this stamp says nothing of"
        )
        yield Check(name="beside", ok=False, detail=detail)
    if changed := list(lies_beside.other(live, statement)):
        detail = f"{_some(changed)}: another than what was accepted, which is in {folder.name}/"
        yield Check(name="beside", ok=True, note=True, detail=detail)
    if added := list(lies_beside.added(live, statement)):
        detail = f"{_some(added)}: beside what was accepted, this stamp says nothing of it"
        yield Check(name="beside", ok=True, note=True, detail=detail)


def _some(names: list[str]) -> str:
    """Names, the first of them where there are many."""
    return ", ".join(names[:8]) + (f" and {len(names) - 8} more" if len(names) > 8 else "")


def _static(run: Run, folder: Path, statement: Statement) -> Iterator[Check]:
    broken = bundle.damage(folder, statement)
    count = sum((folder / s.name).is_file() for s in statement.subject)
    left = len(statement.subject) - count
    kept = f"{count} files as stamped" + (f", {left} left out of the small form" if left else "")
    yield Check(name="checksums", ok=not broken, detail="; ".join(broken[:5]) or kept)
    source = statement.predicate.source
    for what, name, wanted in (
        ("plan", "plan.md", source.plan_sha256),
        ("prompt", "prompt.md", source.prompt_sha256),
    ):
        if wanted and statement.digest_of(name) != wanted:
            yield Check(name=what, ok=False, detail=f"{name} is not the one that was approved")
    wrong = _journal(run, statement, bundle.sha256_file(folder / bundle.STAMP)) if run.journal.is_file() else None
    if wrong is not None:
        seals = sealed.told(Journal(run.journal), sealed.known(folder / signing.PUBLIC))
        told = f"unbroken, and it knows this stamp; {seals}"
        yield Check(name="journal", ok=not wrong, detail=wrong or told)


def _journal(run: Run, statement: Statement, stamped: str) -> str | None:
    """How the run's journal contradicts this stamp; empty when it agrees, None when it does not mention it."""
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
