"""The judges, one file each: services that a user pays, servers that a user runs, and coding harnesses without their tools.

The folder is the list. A judge is handed a question and pictures, or a film, and nothing else; it answers in words, which
`judging_prompt` reads. None has an address by itself: films leave this machine only for one that the user names.
"""

from dataclasses import dataclass
from typing import Protocol

from worldkit.seams import Seam

from ...model.errors import WorldwrightError
from ..exhibit import Piece


class JudgeError(WorldwrightError):
    """A judge gave no answer; `code` says why.

    `not_here` (a program), `unreachable`, `timed_out`, `failed` (its own error), `rate_limited` (`after_s`, if it said when), `unauthorised`, `refused`
    (the call as it is), `declined` (to judge this film), `too_large`, `cut_off` or `garbage`.
    """

    def __init__(self, cause: str, *, code: str, place: str, next_move: str, after_s: float | None = None) -> None:
        super().__init__(cause, place=place, next_move=next_move)
        self.code, self.after_s = code, after_s


@dataclass(frozen=True)
class Question:
    """What a judge is asked about one film."""

    words: str
    pieces: tuple[Piece, ...]
    model: str
    address: str
    """Where it listens, or the harness's program."""
    silent_s: float
    """A judge that says nothing for so long answers nothing."""


@dataclass(frozen=True)
class Answer:
    """What it said."""

    text: str
    model: str = ""
    """As it names itself; empty where it does not."""
    tokens_in: int | None = None
    tokens_out: int | None = None
    cost_usd: float | None = None
    """Where the judge tells it itself."""


@dataclass(frozen=True)
class Limits:
    """What a judge takes in one question."""

    pictures: int
    bytes_each: int
    bytes_together: int
    films: bool = False


class Judge(Protocol):
    """What a module of this folder defines."""

    LIMITS: Limits
    """What it takes; a question beyond it is refused before it is sent."""

    ADDRESS: str
    """The environment variable that holds its address."""

    def starting(self) -> str:
        """How a user comes by one, in a few words."""

    def ask(self, question: Question) -> Answer:
        """Ask once.

        Raises:
            JudgeError: it gave no answer.
        """


SEAM: Seam[Judge] = Seam(__name__, Judge, "judge")
"""Every judge that is known, by the name of its file."""
