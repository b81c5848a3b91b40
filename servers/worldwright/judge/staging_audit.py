"""What of an accepted world's claims came about by itself: a column that a benchmark of films cannot have.

Each claimed outcome (an objective) is one of:

| word | when |
|---|---|
| `emerged` | it is proved, and nothing but the engine's step acted, or switching off all that acted leaves it proved |
| `declared` | it is proved, and it lives by an intervention that the plan declares: without that it fails |
| `drawn` | only the picture shows it (`visual_only`): nothing was measured |
| `timed` | its cause can be taken away and it comes all the same, or it comes at the same instant whatever is changed |
| `untested` | something acted, and nobody switched it off: no audit of causes, or several acted, of which each alone may do |

An intervention that nobody declared stops acceptance; where one is found all the same, what is proved is `untested`.
"""

from collections import Counter
from pathlib import Path
from typing import Literal, TypeVar, get_args

from pydantic import ValidationError

from ..model.errors import NotFoundError, WorldwrightError
from ..model.evidence.audits import CausesReport, InterventionReport
from ..model.evidence.reports import ExpectReport
from ..model.evidence.run import Run, sha256_file
from ..model.frozen import Frozen
from ..stamp.statement import Statement

Origin = Literal["emerged", "declared", "drawn", "timed", "untested"]
ORIGINS: tuple[Origin, ...] = get_args(Origin)
R = TypeVar("R", bound=Frozen)


class Staging(Frozen):
    """Of one world, or of many: how many claimed outcomes came about in which way."""

    counts: dict[Origin, int]
    worlds: int = 1

    @property
    def of(self) -> int:
        """All claimed outcomes."""
        return sum(self.counts.values())

    def text(self) -> str:
        """The shares that there are, such as `3 of 4 emerged, 1 declared`."""
        told = [f"{self.counts[origin]} {origin}" for origin in ORIGINS if self.counts.get(origin)]
        return f"of {self.of}: {', '.join(told)}" if told else "no claim"


def origins(expected: ExpectReport, ledger: InterventionReport, causes: CausesReport | None) -> tuple[Origin, ...]:
    """How each objective came about, by its index."""
    return tuple(
        _origin(one.index, one.status, ledger, causes) for one in sorted(expected.objectives, key=lambda o: o.index)
    )


def of_accepted(run: Run, film_sha256: str = "") -> Staging:
    """How the claims of an accepted world came about, by evidence that is as it was stamped.

    Args:
        film_sha256: the film that was judged, which must be one of the stamped; empty where none was.

    Raises:
        NotFoundError: it is not accepted, or its evidence is not here (of an example in git: build it first).
        WorldwrightError: the evidence is not the stamped one.
    """
    statement = stamped(run)
    if film_sha256 and film_sha256 not in [s.digest.sha256 for s in statement.subject if s.name.endswith(".mp4")]:
        raise WorldwrightError(
            "the film that was judged is none of those that were stamped", place=str(run.accepted),
            next_move="judge the accepted film: worldwright judge run",
        )  # fmt: skip
    expected = _evidence(run.accepted, "expect", ExpectReport, statement)
    ledger = _evidence(run.accepted, "interventions", InterventionReport, statement)
    told = (run.accepted / "evidence/causes.json").is_file()
    causes = _evidence(run.accepted, "causes", CausesReport, statement) if told else None
    found = Counter(origins(expected, ledger, causes))
    return Staging(counts={origin: found[origin] for origin in ORIGINS if found[origin]})


def stamped(run: Run) -> Statement:
    """What the stamp of an accepted run states.

    Raises:
        NotFoundError: it is not accepted.
        WorldwrightError: the stamp cannot be read.
    """
    stamp = run.accepted / "stamp.json"
    if not stamp.is_file():
        raise NotFoundError(
            "it is not accepted here, so nothing of it is claimed", place=str(run.folder),
            next_move=f"worldwright go {run.folder} --accept (of an example: worldwright gallery build)",
        )  # fmt: skip
    return _read(stamp, Statement)


def together(all_of_them: list[Staging]) -> Staging:
    """The claims of many worlds, counted alike."""
    found: Counter[Origin] = Counter()
    for one in all_of_them:
        found.update(one.counts)
    return Staging(counts={origin: found[origin] for origin in ORIGINS if found[origin]}, worlds=len(all_of_them))


def _origin(index: int, status: str, ledger: InterventionReport, causes: CausesReport | None) -> Origin:
    if status == "visual_only":
        return "drawn"
    if status != "proved" or ledger.undeclared:
        return "untested"
    if causes and any(c.objective == index and c.outcome in ("survives", "timed") for c in causes.causes):
        return "timed"
    if not ledger.acting:
        return "emerged"
    if causes is None:
        return "untested"
    if any(index in helper.needed_by for helper in causes.helpers):
        return "declared"
    # The audit switches them off one at a time, and of two motors either may be enough: only a single one is told so.
    switched = {(h.kind, h.target) for h in causes.helpers if not h.failed}
    acting = {(row.kind, row.target) for row in ledger.acting}
    return "emerged" if len(acting) == 1 and acting <= switched else "untested"


def _evidence(folder: Path, name: str, kind: type[R], statement: Statement) -> R:
    path = folder / "evidence" / f"{name}.json"
    if not path.is_file():
        raise NotFoundError(
            f"its evidence is not here: {name}.json", place=str(path),
            next_move="of an example: worldwright gallery build; else restore accepted/",
        )  # fmt: skip
    if sha256_file(path) != statement.digest_of(f"evidence/{name}.json"):
        raise WorldwrightError(
            f"{name}.json is not the one that was stamped", place=str(path), next_move="worldwright stamp verify"
        )
    return _read(path, kind)


def _read(path: Path, kind: type[R]) -> R:
    try:
        return kind.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as cause:
        raise WorldwrightError(
            f"it cannot be read: {str(cause).splitlines()[0]}", place=str(path), next_move="worldwright stamp verify"
        ) from cause
