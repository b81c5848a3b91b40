"""Which of two iterations is better: fewer blocking anomalies, then more objectives proved, then wider margins.

The order is lexicographic: no margin makes up for a lost objective, no objective for motion that cannot be.
"""

import json
from typing import Any, NamedTuple

from ..model.errors import NotFoundError
from ..model.evidence import ExpectationResult, ExpectReport, ScanReport
from ..model.run import Run
from .tools import Comparison

STANDING = {"refuted": 0, "unproved": 1, "visual_only": 1, "proved": 2}
"""What only eyes can judge is worth less than a proof: taking the measurement out of a claim is no improvement."""
NOTABLE = 0.05
"""A change of a margin, as a share of what it is measured against, that is worth telling."""
DECIDES = 0.01
MOST_TOLD = 12


class Rank(NamedTuple):
    """Larger is better, the first place that differs decides."""

    blocking: int
    """Minus the number of blocking anomalies."""
    objectives: int
    """The objectives' standings summed up."""
    margins: float
    """The mean margin of all expectations, each as a share of its scale, -1 to 1."""


def compare_reports(run: Run, first: str, second: str) -> Comparison:
    """Compare the kept reports of two evidence keys; a missing one is a `NotFoundError` that lists the keys."""
    (scan_a, expect_a), (scan_b, expect_b) = (_reports(run, key) for key in (first, second))
    pairs = _pairs(expect_a, expect_b)
    gained, lost = _anomalies(scan_a, scan_b), _anomalies(scan_b, scan_a)
    improved = [f"no more {a.name} of {a.body}" for a in gained]
    worsened = [f"new {a.name} of {a.body}: {a.message}" for a in lost]
    for claim, (earlier, later) in _claims(expect_a, expect_b).items():
        if STANDING[earlier] != STANDING[later]:
            text = f"{claim} {earlier} before, {later} now"
            (improved if STANDING[later] > STANDING[earlier] else worsened).append(text)
    improved += _only(expect_b, expect_a, "claimed only by the second")
    worsened += _only(expect_a, expect_b, "claimed only by the first")
    changes = sorted(((strength(b) - strength(a), a, b) for a, b in pairs), key=lambda change: -abs(change[0]))
    for change, a, b in changes[:MOST_TOLD]:
        if abs(change) >= NOTABLE:
            (improved if change > 0 else worsened).append(f"{a.name}: {_told(a)}, then {_told(b)}")
    rank_a, rank_b = _rank(scan_a, expect_a, [a for a, _ in pairs]), _rank(scan_b, expect_b, [b for _, b in pairs])
    better, decided = _decide(rank_a, rank_b)
    return Comparison.model_validate(
        {
            "better": better, "first": first, "second": second, "improved": improved, "worsened": worsened,
            "decided_by": decided, "ranks": (rank_a._asdict(), rank_b._asdict()),
        }
    )  # fmt: skip


def strength(result: ExpectationResult) -> float:
    """A margin as a share of what it is measured against, -1 to 1; what was not measured is 0."""
    if result.margin is None or result.measured is None:
        return 0.0
    scale = max(abs(result.measured), abs(result.measured - result.margin), abs(result.margin))
    return result.margin / scale if scale > 0 else 0.0


def _decide(first: Rank, second: Rank) -> tuple[str, str]:
    for name in ("blocking", "objectives"):
        if getattr(first, name) != getattr(second, name):
            return ("first" if getattr(first, name) > getattr(second, name) else "second"), name
    if abs(first.margins - second.margins) >= DECIDES:
        return ("first" if first.margins > second.margins else "second"), "margins"
    return "equal", "nothing"


def _rank(scan: ScanReport, expected: ExpectReport, results: list[ExpectationResult]) -> Rank:
    blocking = sum(a.severity == "blocking" for a in scan.anomalies)
    standing = sum(STANDING[o.status] for o in expected.objectives)
    margins = sum(strength(r) for r in results) / len(results) if results else 0.0
    return Rank(-blocking, standing, round(margins, 6))


def _anomalies(before: ScanReport, after: ScanReport) -> list[Any]:
    """Blocking anomalies of `before`, one of a kind and body, that `after` does not have."""
    known = {(a.code, a.body) for a in after.anomalies if a.severity == "blocking"}
    gone = {(a.code, a.body): a for a in before.anomalies if a.severity == "blocking"}
    return [a for pair, a in gone.items() if pair not in known]


def _claims(one: ExpectReport, other: ExpectReport) -> dict[str, tuple[str, str]]:
    """The statuses of the claims that both make."""
    before = {o.claim: o.status for o in one.objectives}
    return {o.claim: (before[o.claim], o.status) for o in other.objectives if o.claim in before}


def _only(here: ExpectReport, there: ExpectReport, how: str) -> list[str]:
    known = {o.claim for o in there.objectives}
    return [f"{o.claim} {o.status}, {how}" for o in here.objectives if o.claim not in known and STANDING[o.status] == 2]


def _pairs(one: ExpectReport, other: ExpectReport) -> list[tuple[ExpectationResult, ExpectationResult]]:
    """The same expectation of the same claim in both; a margin against another demand would compare nothing."""

    def keyed(report: ExpectReport) -> dict[tuple[str, str, str], ExpectationResult]:
        return {
            (o.claim, e.name, json.dumps(e.arguments, sort_keys=True)): e
            for o in report.objectives
            for e in o.expectations
        }

    before, after = keyed(one), keyed(other)
    return [(before[key], after[key]) for key in before if key in after]


def _told(result: ExpectationResult) -> str:
    margin = "" if result.margin is None else f" by {abs(result.margin):.3g} {result.unit}"
    return f"{result.status}{margin}"


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
