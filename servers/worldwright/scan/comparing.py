"""Which of two iterations is better: first by blocking anomalies, then by objectives proved, then by margins."""

from ..model.errors import NotFoundError
from ..model.evidence import ExpectReport, ScanReport
from ..model.run import Run
from .tools import Comparison


def compare_reports(run: Run, first: str, second: str) -> Comparison:
    """Compare the kept reports of two evidence keys; a missing one is a `NotFoundError` that lists the keys."""
    (scan_a, expect_a), (scan_b, expect_b) = (_reports(run, key) for key in (first, second))
    improved, worsened = [], []
    before = {(a.code, a.body): a for a in scan_a.anomalies if a.severity == "blocking"}
    after = {(a.code, a.body): a for a in scan_b.anomalies if a.severity == "blocking"}
    improved += [f"no more {a.name} of {a.body}" for pair, a in before.items() if pair not in after]
    worsened += [f"new {a.name} of {a.body}: {a.message}" for pair, a in after.items() if pair not in before]
    rank = {"refuted": 0, "unproved": 1, "visual_only": 2, "proved": 2}
    claims = {o.claim: o for o in expect_a.objectives}
    for later in expect_b.objectives:
        earlier = claims.get(later.claim)
        if earlier is None or rank[earlier.status] == rank[later.status]:
            continue
        text = f"{later.claim} {earlier.status} before, {later.status} now"
        (improved if rank[later.status] > rank[earlier.status] else worsened).append(text)
    score = len(improved) - len(worsened)
    better = "equal" if not score else "second" if score > 0 else "first"
    return Comparison.model_validate(
        {"better": better, "first": first, "second": second, "improved": improved, "worsened": worsened}
    )


def _reports(run: Run, key: str) -> tuple[ScanReport, ExpectReport]:
    folder = run.evidence(key)
    try:
        return (
            ScanReport.model_validate_json((folder / "scan.json").read_text(encoding="utf-8")),
            ExpectReport.model_validate_json((folder / "expect.json").read_text(encoding="utf-8")),
        )
    except (OSError, ValueError) as cause:
        known = sorted(p.parent.name for p in (run.folder / "evidence").glob("*/expect.json"))
        raise NotFoundError(
            f"iteration {key} was not scanned and measured: {cause}",
            place=str(folder),
            next_move=f"iterations that were: {', '.join(known) or '(none)'}",
        ) from cause
