"""Every film before the judge: each vote is asked for once, kept as it comes, and never paid again.

What is wrong with one film (it is declined, or answered in no form) leaves that film undecided; what is wrong with the judge (no
right, not there, too many questions) ends the hearing, and what was voted stays. Films that failed the last time are asked about
last, so that a few of them never keep the others from being heard.
"""

import contextlib
import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from ..model.errors import NotFoundError
from ..model.evidence.run import sha256_file
from . import judging_prompt
from .ballot import TieError
from .criteria import Scenario
from .entrants import Entrant
from .exhibit import ExhibitError, exhibit
from .judges import SEAM, Judge, JudgeError, Question
from .patience import Patience
from .verdict_record import FilmRecord, Protocol, Records, Vote

ENDS = frozenset({"not_here", "unauthorised", "refused", "unreachable", "rate_limited", "failed"})
"""Such a failure is about the judge: the next film would meet it, too."""
ALIKE, OF_A_FILM = 3, frozenset({"declined", "too_large"})
"""So many films in a row that fail alike are about the judge as well, unless it is a matter of each film."""


@dataclass(frozen=True)
class Bench:
    """Who judges, and how."""

    protocol: Protocol
    words: str
    address: str
    """As it is called; the protocol's lacks what may be secret in it."""
    votes: int = 1
    silent_s: float = 120.0
    patience: Patience = field(default_factory=Patience)

    @property
    def judge(self) -> Judge:
        """The judge's module."""
        return SEAM.find(self.protocol.judge)


@dataclass
class Heard:
    """What came of it."""

    asked: int = 0
    """Questions that were answered now."""
    decided: int = 0
    undecided: dict[str, str] = field(default_factory=dict)
    """By scenario, why."""
    ended: JudgeError | None = None


def odd(votes: int) -> int:
    """So many votes, which cannot tie.

    Raises:
        TieError: an even number.
    """
    if votes < 1 or votes % 2 == 0:
        raise TieError(
            f"{votes} votes may tie, and a tie is no verdict", place="--votes", next_move="give an odd number: 1, 3, 5"
        )
    return votes


def size(entrants: Mapping[str, Entrant], bench: Bench) -> tuple[int, int]:
    """How many questions all films come to, and about how many bytes would be sent, before one is asked."""
    questions = len(entrants) * bench.votes
    for sample in entrants.values():
        with contextlib.suppress(ExhibitError):  # the next one is as good a sample
            shown = exhibit(sample.film, bench.protocol.form, bench.protocol.frames)
            return questions, questions * sum(len(piece.data) for piece in shown.pieces) * 4 // 3
    return questions, 0


def hear(
    records: Records,
    scenarios: Mapping[str, Scenario],
    entrants: Mapping[str, Entrant],
    bench: Bench,
    say: Callable[[str], None] = lambda _: None,
    films: Path | None = None,
) -> Heard:
    """Put films before the judge, one after the other.

    Args:
        scenarios: by id; every entrant's must be there.
        films: where they lie; verdicts about films of another place are then refused, and only these count.

    Raises:
        NotFoundError: there are no criteria for a film.
        RecordError: another hearing of the same verdicts is under way, or they are about films of another place.
    """
    if missing := [id for id in entrants if id not in scenarios]:
        raise NotFoundError(
            f"there are no criteria for {len(missing)} films: {', '.join(missing[:8])}", place="--criteria",
            next_move="name a folder whose files have these scenarios, or leave those films away",
        )  # fmt: skip
    with records.held():
        if films is not None:
            records.enter(films, entrants)
        return _heard(records, scenarios, entrants, bench, say)


def _heard(
    records: Records,
    scenarios: Mapping[str, Scenario],
    entrants: Mapping[str, Entrant],
    bench: Bench,
    say: Callable[[str], None],
) -> Heard:
    heard, alike = Heard(), [""]
    waiting: list[tuple[FilmRecord, str]] = []
    # All films are entered before the first question: a hearing that ends early leaves them undecided, not without a film.
    for id, entrant in entrants.items():
        try:
            waiting.append(_entered(records, scenarios[id], entrant, bench))
        except ExhibitError as error:
            records.write(_not_shown(scenarios[id], entrant, bench, error))
            heard.undecided[id] = f"{error.code}: {error.cause}"
            say(f"{id}: {error.cause}")
    waiting.sort(key=lambda one: bool(one[0].failed_code))
    for record, words in waiting:
        id, question = record.id, Question(words, records.pieces(record), *_called(bench))
        try:
            while len(record.votes) < bench.votes:
                record = _vote(records, record, question, bench)
                heard.asked += 1
                alike = [""]
                say(f"{id}: vote {len(record.votes)} of {bench.votes}")
            record.decided()
            heard.decided += 1
        except TieError as error:
            heard.undecided[id] = error.cause
        except JudgeError as error:
            records.write(record.model_copy(update={"failed": error.cause, "failed_code": error.code}))
            heard.undecided[id] = f"{error.code}: {error.cause}"
            say(f"{id}: {error.cause}")
            alike = [*alike, error.code] if error.code == alike[-1] else [error.code]
            if error.code in ENDS or (len(alike) >= ALIKE and error.code not in OF_A_FILM):
                heard.ended = error
                break
    return heard


def _entered(records: Records, scenario: Scenario, entrant: Entrant, bench: Bench) -> tuple[FilmRecord, str]:
    """A film's record with the votes that there are of it, and the question about it."""
    shown = exhibit(entrant.film, bench.protocol.form, bench.protocol.frames)
    words = judging_prompt.asked(bench.words, scenario.criteria, shown.told)
    record = FilmRecord(
        id=scenario.id,
        category=scenario.category,
        criteria=scenario.criteria,
        criteria_sha256=scenario.criteria.sha256,
        film_sha256=sha256_file(entrant.film),
        exhibit=records.keep_exhibit(shown),
        question_sha256=records.keep("questions", words.encode(), "txt"),
        run=str(entrant.run.resolve()) if entrant.run else "",
    )
    found = records.find(record).model_copy(update={"wanted": bench.votes, "run": record.run})
    return records.write(found), words


def _not_shown(scenario: Scenario, entrant: Entrant, bench: Bench, error: ExhibitError) -> FilmRecord:
    """The record of a film that no judge can be shown: it stays undecided until it is mended."""
    return FilmRecord(
        id=scenario.id,
        category=scenario.category,
        criteria=scenario.criteria,
        criteria_sha256=scenario.criteria.sha256,
        film_sha256=sha256_file(entrant.film) if entrant.film.is_file() else "",
        exhibit=(),
        question_sha256="",
        run=str(entrant.run.resolve()) if entrant.run else "",
        wanted=bench.votes,
        failed=error.cause,
        failed_code=error.code,
    )


def _called(bench: Bench) -> tuple[str, str, float]:
    return bench.protocol.model, bench.address, bench.silent_s


def _vote(records: Records, record: FilmRecord, question: Question, bench: Bench) -> FilmRecord:
    fits(question, bench.judge, bench.protocol.judge)

    def once() -> Vote:
        answer = bench.judge.ask(question)
        judging_prompt.answered(answer.text, record.criteria.fields, bench.protocol.judge)
        text = answer.text.encode(errors="replace").decode()  # halves of a character would not be written
        return Vote(
            text=text,
            sha256=hashlib.sha256(text.encode()).hexdigest(),
            model=answer.model,
            tokens_in=answer.tokens_in,
            tokens_out=answer.tokens_out,
            cost_usd=answer.cost_usd,
            at=datetime.now(UTC).isoformat(timespec="seconds"),
        )

    vote, tries = bench.patience.ask(once)
    vote = vote.model_copy(update={"tries": tries})
    return records.write(record.model_copy(update={"votes": (*record.votes, vote), "failed": "", "failed_code": ""}))


def fits(question: Question, judge: Judge, name: str) -> None:
    """Refuse what a judge does not take, before it is sent.

    Raises:
        JudgeError: `too_large`.
    """
    most, sizes = judge.LIMITS, [len(piece.data) for piece in question.pieces]
    film = any(piece.media_type.startswith("video/") for piece in question.pieces)
    why = ""
    if film and not most.films:
        why = "it takes pictures, no films"
    elif len(sizes) > most.pictures:
        why = f"it takes {most.pictures} pictures, not {len(sizes)}"
    elif max(sizes) > most.bytes_each or sum(sizes) > most.bytes_together:
        why = f"{sum(sizes):,} B are more than it takes"
    if why:
        raise JudgeError(why, code="too_large", place=name, next_move="show less: --shows sheet, or fewer --frames")
