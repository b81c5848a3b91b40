"""Whether a world that was simulated again does what its stamp says: every expectation is measured anew, and it is scanned."""

from collections.abc import Iterator
from pathlib import Path

from ..model.errors import JobError, WorldwrightError
from ..model.evidence.reports import ExpectReport
from ..model.storage import StorageError
from . import agreement
from .as_stamped import Check
from .kept import Kept
from .proof import Proved, measure
from .statement import Statement


def checks(folder: Path, statement: Statement, proved: Proved, exact: bool) -> Iterator[Check]:
    """The expectations and the anomaly scan of the new recording; `exact`: its motion is the stamped one bit for bit."""
    from ..scan import tools as scan

    try:
        report = measure(proved)
        scanned = scan.scan(str(proved.run.folder))
    except (JobError, StorageError):
        raise  # the machine, or the end of the call, tells nothing of the world
    except WorldwrightError as error:
        yield Check(name="expectations", ok=False, detail=str(error))
        return
    changed = list(_told_otherwise(folder, statement, report, exact))
    yield Check(
        name="expectations",
        ok=not changed,
        detail="; ".join(changed[:5]) or f"all as stamped ({len(statement.predicate.expectations)})",
    )
    blocking = [a for a in scanned.anomalies if a.severity == "blocking"]
    checks = sum(c.status != "skipped" for c in scanned.checks)
    yield Check(name="scan", ok=not blocking, detail=str(blocking[0]) if blocking else f"{checks} checks, none blocks")


def _told_otherwise(folder: Path, statement: Statement, report: ExpectReport, exact: bool) -> Iterator[str]:
    """Where the stamp, or the report beside it, differs from the new recording; `exact`: the motion is the same bit for bit."""
    stamp = statement.predicate
    claims = {o.index: o.claim for o in report.objectives}
    for o in stamp.objectives:
        if claims.get(o.index) != o.claim:
            yield f"objective {o.index} is not the plan's: `{o.claim}`"
    yield from agreement.other_statuses({o.index: o.status for o in stamp.objectives}, agreement.statuses(report))
    slack = agreement.SAME if exact else agreement.ALIKE
    measured = agreement.numbers(report)
    said = [(e.objective, e.name, e.status, e.measured, e.margin) for e in stamp.expectations]
    yield from agreement.other_numbers(said, measured, slack)
    kept = Kept.read(folder / "evidence" / "expect.json", ExpectReport).value
    if kept is not None:
        found = agreement.other_numbers(agreement.numbers(kept), measured, slack)
        yield from (f"evidence/expect.json: {text}" for text in found)
