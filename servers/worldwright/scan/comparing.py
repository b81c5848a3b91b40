"""Tell which of two iterations is better: fewer blocking anomalies, then more objectives proved, then wider margins.

The order is lexicographic: no margin makes up for a lost objective, no objective for motion that cannot be.
"""

import json
from typing import Any, Literal, NamedTuple

from ..model.errors import NotFoundError
from ..model.evidence.reports import ExpectationResult, ExpectReport, ScanReport
from ..model.evidence.run import Run
from ..model.frozen import Frozen

STANDING = {"refuted": 0, "unproved": 1, "visual_only": 1, "proved": 2}
"""A claim that only eyes can judge is worth less than a proof: to drop its measurement is no improvement."""
NOTABLE = 0.05
"""A change of a margin is told from this share of its scale on."""
DECIDES = 0.01
MOST_TOLD = 12


class Standing(Frozen):
    """How good one iteration is: larger is better, and the first field that differs decides."""

    blocking: int
    """Minus the number of blocking anomalies."""
    objectives: int
    """Two for each objective proved, one for each visual only or unproved."""
    margins: float
    """Mean margin of the expectations that both have, each as a share of its scale, -1 to 1."""


class Comparison(Frozen):
    """Two iterations of a run, the better one named."""

    better: Literal["first", "second", "equal"]
    first: str
    second: str
    improved: tuple[str, ...] = ()
    """The points in which the second iteration is better."""
    worsened: tuple[str, ...] = ()
    decided_by: Literal["blocking", "objectives", "margins", "nothing"] = "nothing"
    """Blocking anomalies first, then objectives, then margins: the first that differs."""
    ranks: tuple[Standing, ...] = ()
    """The standings of the first and of the second iteration."""

    def text(self) -> str:
        """The verdict and its reasons."""
        head = {"first": f"{self.first} is better", "second": f"{self.second} is better", "equal": "neither is better"}
        why = {
            "blocking": ": fewer blocking anomalies",
            "objectives": ": more objectives hold",
            "margins": ": wider margins, all else alike",
            "nothing": "",
        }
        return "\n".join(
            [
                head[self.better] + why[self.decided_by],
                *(f"+ {t}" for t in self.improved),
                *(f"- {t}" for t in self.worsened),
            ]
        )


class Rank(NamedTuple):
    """The rank of an iteration: larger is better, and the first field that differs decides."""

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
            (improved if change > 0 else worsened).append(f"{a.name}: {_describe(a)}, then {_describe(b)}")
    rank_a, rank_b = _rank(scan_a, expect_a, [a for a, _ in pairs]), _rank(scan_b, expect_b, [b for _, b in pairs])
    better, decided = _decide(rank_a, rank_b)
    return Comparison.model_validate(
        {
            "better": better, "first": first, "second": second, "improved": improved, "worsened": worsened,
            "decided_by": decided, "ranks": (rank_a._asdict(), rank_b._asdict()),
        }
    )  # fmt: skip


def strength(result: ExpectationResult) -> float:
    """A margin as a share of its scale, -1 to 1; 0 without a measurement."""
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
    """Blocking anomalies of `before` that `after` lacks, one for each kind and body."""
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
    """Pairs of the same expectation of the same claim; margins against different demands cannot be compared."""

    def keyed(report: ExpectReport) -> dict[tuple[str, str, str], ExpectationResult]:
        return {
            (o.claim, e.name, json.dumps(e.arguments, sort_keys=True)): e
            for o in report.objectives
            for e in o.expectations
        }

    before, after = keyed(one), keyed(other)
    return [(before[key], after[key]) for key in before if key in after]


def _describe(result: ExpectationResult) -> str:
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
