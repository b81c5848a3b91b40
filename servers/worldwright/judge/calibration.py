"""How often a judge is right about films whose fault is known, and whether it may judge others.

A field that should be answered Yes and is: true positive; No, and is answered Yes: false positive, the fault is overlooked. A judge is
fit when it says Yes to at least 80 % of what is so and No to at least 80 % of what is not; one that says the same to all
is named. Both shares have Wilson's interval: three worlds with five faults are few.
"""

from collections.abc import Iterable

from ..model.frozen import Frozen
from . import planted
from .ballot import TieError
from .tally import Share
from .verdict_record import FilmRecord

LEAST = 0.8


class Matrix(Frozen):
    """The confusion matrix of a judge, over fields of films with a known answer."""

    yes_yes: int = 0
    """It is so, and the judge says so."""
    yes_no: int = 0
    """It is so, and the judge denies it."""
    no_yes: int = 0
    """It is not so, and the judge says it is: an overlooked fault."""
    no_no: int = 0

    @property
    def sensitivity(self) -> Share:
        """Of what is so, how much it says Yes to."""
        return Share(passed=self.yes_yes, of=self.yes_yes + self.yes_no)

    @property
    def specificity(self) -> Share:
        """Of what is not so, how much it says No to."""
        return Share(passed=self.no_no, of=self.no_no + self.no_yes)


class Calibrated(Frozen):
    """What a judge's answers on the planted films come to."""

    matrix: Matrix
    found: dict[str, Share]
    """By fault: films of which every decided field was answered rightly."""
    films: int
    undecided: tuple[str, ...] = ()
    """Films without a verdict; of a fit judge there is none."""
    missing: tuple[str, ...] = ()
    """Films that it has not seen yet."""

    @property
    def unfit(self) -> tuple[str, ...]:
        """Why it may not judge; empty for a fit one."""
        matrix, why = self.matrix, []
        right, wrong = matrix.sensitivity, matrix.specificity
        if self.missing or self.undecided:
            why.append(
                f"{len(self.missing) + len(self.undecided)} of its {self.films + len(self.missing)} films are not judged"
            )
        if wrong.of and wrong.passed == 0 and right.passed == right.of:
            why.append("it says Yes to all")
        elif right.of and right.passed == 0 and wrong.passed == wrong.of:
            why.append("it says No to all")
        else:
            if right.value < LEAST:
                why.append(f"it denies what is so: Yes to {right.text()}")
            if wrong.value < LEAST:
                why.append(f"it overlooks faults: No to {wrong.text()}")
        return tuple(why)

    @property
    def fit(self) -> bool:
        """Whether its verdicts on other films may stand in a table."""
        return not self.unfit

    def text(self) -> str:
        """The matrix, the faults and the word."""
        m = self.matrix
        lines = [
            (
                f"{self.films} films with a known answer: it is so: {m.yes_yes} Yes, {m.yes_no} No; "
                f"it is not so: {m.no_yes} Yes, {m.no_no} No"
            ),
            *(f"  {fault}: {share.passed} of {share.of} films answered rightly" for fault, share in self.found.items()),
            "fit to judge" if self.fit else f"UNFIT to judge: {'; '.join(self.unfit)}",
        ]
        return "\n".join(lines)


def calibrated(records: Iterable[FilmRecord]) -> Calibrated:
    """Compare a judge's verdicts on planted films with what was planted; films of other names are left out."""
    counts = {"yes_yes": 0, "yes_no": 0, "no_yes": 0, "no_no": 0}
    right: dict[str, list[bool]] = {}
    undecided, seen = [], set()
    for record in records:
        try:
            fault, answers = planted.answers(record.id)
        except ValueError:
            continue
        seen.add(record.id)
        try:
            fields = record.decided().fields
        except TieError:
            undecided.append(record.id)
            continue
        for name, so in answers.items():
            counts[f"{'yes' if so else 'no'}_{'yes' if fields[name] else 'no'}"] += 1
        right.setdefault(fault, []).append(all(fields[name] == so for name, so in answers.items()))
    found = {f: Share(passed=sum(right[f]), of=len(right[f])) for f in planted.FAULTS if f in right}
    missing = tuple(id for id in planted.scenarios() if id not in seen)
    return Calibrated(
        matrix=Matrix(**counts), found=found, films=len(seen), undecided=tuple(undecided), missing=missing
    )
