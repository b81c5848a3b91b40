"""SA, PC and both, per category and overall: what share of the scenarios passes, with Wilson's interval.

A scenario without a film stays in the denominator as one that does not pass; one that is not decided (a tie, a judge that could
not be reached) makes no row at all, since it is no answer about the film.
"""

from collections.abc import Iterable, Mapping

from ..model.frozen import Frozen
from . import intervals
from .ballot import Decided

OVERALL = "Overall"


class Share(Frozen):
    """So many of so many."""

    passed: int
    of: int

    @property
    def value(self) -> float:
        """The share in 0..1; 0 of nothing."""
        return self.passed / self.of if self.of else 0.0

    @property
    def within(self) -> tuple[float, float]:
        """Wilson's interval of 95 %."""
        return intervals.wilson(self.passed, self.of)

    def text(self) -> str:
        """In percent, with its interval."""
        low, high = self.within
        return f"{100 * self.value:.1f} % [{100 * low:.1f}, {100 * high:.1f}]"


class Group(Frozen):
    """The scenarios of one category, or all of them."""

    name: str
    sa: Share
    pc: Share
    both: Share


class Agreement(Frozen):
    """How far the votes on each field agree."""

    questions: int
    """Fields of all films on which there was more than one vote."""
    unanimous: int
    kappa: float | None = None
    """Fleiss' kappa over films with the usual number of votes; None where it says nothing."""

    def text(self) -> str:
        """In words."""
        if not self.questions:
            return "one vote each"
        kappa = "not defined" if self.kappa is None else f"{self.kappa:.2f}"
        return f"{self.unanimous} of {self.questions} fields unanimous, Fleiss' kappa {kappa}"


class Tally(Frozen):
    """What a judge's verdicts come to."""

    groups: tuple[Group, ...]
    """Categories in the order of the set, then all together."""
    standards: Share
    """Key standards of the judged films that hold."""
    without_film: tuple[str, ...] = ()
    agreement: Agreement

    @property
    def overall(self) -> Group:
        """Of all scenarios."""
        return self.groups[-1]


def tally(asked: Mapping[str, str], decided: Mapping[str, Decided]) -> Tally:
    """Count verdicts.

    Args:
        asked: category by id of every scenario that was asked for, film or not.
        decided: the verdict by id of each that has a film.
    """
    names = dict.fromkeys(asked.values())
    groups = [_group(name, [id for id, category in asked.items() if category == name], decided) for name in names]
    fields = [held for one in decided.values() for name, held in one.fields.items() if name not in ("Objects", "Event")]
    return Tally(
        groups=(*groups, _group(OVERALL, list(asked), decided)),
        standards=Share(passed=sum(fields), of=len(fields)),
        without_film=tuple(id for id in asked if id not in decided),
        agreement=agreement(decided.values()),
    )


def agreement(decided: Iterable[Decided]) -> Agreement:
    """How far the votes agree, over all fields of all films."""
    several = [one for one in decided if one.votes > 1]
    pairs = [(yes, one.votes) for one in several for yes in one.yes.values()]
    counts = [one.votes for one in several]
    usual = max(set(counts), key=lambda count: (counts.count(count), count), default=0)
    same = [yes for yes, votes in pairs if votes == usual]
    return Agreement(
        questions=len(pairs),
        unanimous=sum(yes in (0, votes) for yes, votes in pairs),
        kappa=intervals.fleiss_kappa(same, usual),
    )


def _group(name: str, ids: list[str], decided: Mapping[str, Decided]) -> Group:
    found = [decided[id] for id in ids if id in decided]
    return Group(
        name=name,
        sa=Share(passed=sum(one.adheres for one in found), of=len(ids)),
        pc=Share(passed=sum(one.correct for one in found), of=len(ids)),
        both=Share(passed=sum(one.both for one in found), of=len(ids)),
    )
