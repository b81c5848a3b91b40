"""What was shown, asked and answered, by hash: the folder of one judge's verdicts, which nobody who builds reads.

| path | what |
|---|---|
| `protocol.json` | judge, model, address, exhibit and the words' hash: verdicts of another protocol lie elsewhere |
| `entered.json` | which films were judged: where they lay, and the scenarios that the last hearing entered |
| `verdicts/ID.json` | a film: criteria, hashes of film, exhibit and question, each vote in the judge's own words |
| `calibration/verdicts/ID.json` | the same of a film with a planted fault, or a sound one |
| `questions/SHA256.txt`, `exhibits/SHA256.jpg` | what a hash is of |
| `earlier/` | votes on a film that is another by now, or was asked about otherwise; they count again once both are as they were |

It lies in no run and in no project, where builders read: `outside` refuses it. Answers are read out of the judge's words again
each time that a record is read, so that no number of a report is anything but what the judge said.
"""

import contextlib
import hashlib
import os
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import TypeVar

from pydantic import ValidationError

from worldkit.data_folders import data_root
from worldkit.files import write_atomic

from ..contract.users_data import JUDGED
from ..model import try_lock
from ..model.errors import NotFoundError, WorldwrightError
from ..model.frozen import Frozen
from ..model.storage import writing
from . import ballot, judging_prompt
from .criteria import Criteria
from .exhibit import Exhibit, Form, Piece
from .judges import JudgeError

PROTOCOL, ENTERED, CALIBRATION = "protocol.json", "entered.json", "calibration"
ENDINGS = {"image/jpeg": "jpg", "video/mp4": "mp4"}
R = TypeVar("R", bound=Frozen)
INSIDE = ("plan.md", "simulation.py", "campaign.json", "AGENTS.md")
"""A folder that holds one of these is a run, a campaign or a project, in which builders read."""


class RecordError(WorldwrightError):
    """A record is not what it was, or not of this protocol."""

    code = "record"


class Protocol(Frozen):
    """How all films of one folder are judged."""

    judge: str
    model: str
    address: str
    form: Form
    frames: int
    words_sha256: str
    own_words: bool = True
    """The question is in our words, not in a user's."""

    @property
    def sha256(self) -> str:
        """Over all of it."""
        return hashlib.sha256(self.model_dump_json().encode()).hexdigest()

    def text(self) -> str:
        """In one line."""
        shown = "the whole film" if self.form == "film" else f"{self.frames} frames as {self.form}"
        words = "our words" if self.own_words else "the user's words"
        return f"{self.judge} {self.model or '(its usual model)'}, {shown}, {words} {self.words_sha256[:12]}"


class EnteredFilms(Frozen):
    """What one folder of verdicts is about: the films of one place, of which only those of the last hearing count."""

    films: str
    """The folder, list or campaign, as a whole path."""
    ids: tuple[str, ...]


class Vote(Frozen):
    """One answer, in the judge's own words."""

    text: str
    sha256: str
    model: str = ""
    tokens_in: int | None = None
    tokens_out: int | None = None
    cost_usd: float | None = None
    tries: int = 1
    at: str
    """ISO 8601, UTC."""


class FilmRecord(Frozen):
    """One film before the judge."""

    id: str
    category: str = ""
    criteria: Criteria
    criteria_sha256: str
    film_sha256: str
    exhibit: tuple[str, ...]
    """The files of its pieces in `exhibits/`, in order, each named by its SHA-256."""
    question_sha256: str
    run: str = ""
    """The run folder that the film is of, for the audit of staging; the judge is not told."""
    wanted: int = 1
    """So many votes were asked for."""
    votes: tuple[Vote, ...] = ()
    failed: str = ""
    """Why the last vote is missing."""
    failed_code: str = ""

    def answers(self) -> list[dict[str, bool]]:
        """By vote: the answers, read from the judge's words."""
        return [judging_prompt.answered(vote.text, self.criteria.fields, self.id) for vote in self.votes]

    def decided(self) -> ballot.Decided:
        """The verdict.

        Raises:
            TieError: the votes are tied, or some that were asked for are missing.
        """
        if len(self.votes) < self.wanted:
            raise ballot.TieError(
                f"{len(self.votes)} of {self.wanted} votes{f': {self.failed}' if self.failed else ''}",
                place=f"scenario {self.id}", next_move="the same command goes on: worldwright judge run …",
            )  # fmt: skip
        return ballot.decide(self.answers(), self.criteria.fields, f"scenario {self.id}")

    @property
    def subject_sha256(self) -> str:
        """Over what was judged and asked; without the votes, where the film came from, and the pictures made of the film.

        A decoder that gives other last bits would otherwise have votes paid again.
        """
        told = self.model_dump_json(exclude={"votes", "failed", "failed_code", "run", "wanted", "exhibit"})
        return hashlib.sha256(told.encode()).hexdigest()

    def same_as(self, other: "FilmRecord") -> bool:
        """Whether both are about the same film, asked about alike."""
        return self.subject_sha256 == other.subject_sha256


class Records:
    """A folder of verdicts.

    Args:
        folder: it; or `Records.at`, which refuses a place where builders read.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    @classmethod
    def at(cls, folder: Path | None, name: str) -> "Records":
        """The folder that is named, else one of the person's data folder.

        Raises:
            RecordError: builders would read it.
        """
        return cls(outside(folder if folder is not None else data_root() / JUDGED / name))

    @property
    def calibration(self) -> "Records":
        """The same of the films with a planted fault."""
        return Records(self.folder / CALIBRATION)

    def begin(self, protocol: Protocol, words: str) -> None:
        """Say how its films are judged, once and for all.

        Raises:
            RecordError: they are judged otherwise.
        """
        if (self.folder / PROTOCOL).is_file():
            if (before := self.protocol()) != protocol:
                raise RecordError(
                    f"verdicts of another protocol lie here: {before.text()}; yours: {protocol.text()}",
                    place=str(self.folder),
                    next_move="name another folder: --out FOLDER",
                )
            return
        with writing("the record", self.folder):
            self.keep("questions", words.encode(), "txt")
            write_atomic(self.folder / PROTOCOL, protocol.model_dump_json(indent=2) + "\n")

    @contextlib.contextmanager
    def held(self) -> Iterator[None]:
        """Nobody else asks about these films meanwhile: what two ask at once is paid twice.

        Raises:
            RecordError: somebody does.
        """
        with writing("the record", self.folder):
            self.folder.mkdir(parents=True, exist_ok=True)
            handle = os.open(self.folder, os.O_RDONLY)
        try:
            if not try_lock.taken(handle):
                raise RecordError(
                    "another hearing of these verdicts is under way", place=str(self.folder),
                    next_move="let it end; of a second judge name another folder: --out FOLDER",
                )  # fmt: skip
            yield
        finally:
            os.close(handle)

    def enter(self, films: Path, ids: Iterable[str]) -> None:
        """Say which films are judged here: those of one place, of which the given ones count from now on.

        Raises:
            RecordError: verdicts about films of another place lie here.
        """
        path, source = self.folder / ENTERED, str(films.resolve())
        if (before := self.entered()) is not None and before.films != source:
            raise RecordError(
                f"verdicts about other films lie here: {before.films}; yours: {source}", place=str(self.folder),
                next_move="name another folder: --out FOLDER",
            )  # fmt: skip
        with writing("the record", path):
            write_atomic(path, EnteredFilms(films=source, ids=tuple(ids)).model_dump_json(indent=2) + "\n")

    def entered(self) -> EnteredFilms | None:
        """Which films count, or None where nobody said."""
        path = self.folder / ENTERED
        return _parsed(path, EnteredFilms) if path.is_file() else None

    def protocol(self) -> Protocol:
        """How its films are judged.

        Raises:
            NotFoundError: there are no verdicts here.
            RecordError: it cannot be read.
        """
        path = self.folder / PROTOCOL
        if not path.is_file():
            raise NotFoundError(
                "no verdicts are here",
                place=str(self.folder),
                next_move="worldwright judge run FILMS --criteria FOLDER",
            )
        return _parsed(path, Protocol)

    def keep(self, kind: str, content: bytes, ending: str) -> str:
        """Keep what a hash is of; returns the hash."""
        sha256 = hashlib.sha256(content).hexdigest()
        path = self.folder / kind / f"{sha256}.{ending}"
        if not path.is_file():
            write_atomic(path, content)
        return sha256

    def keep_exhibit(self, shown: Exhibit) -> tuple[str, ...]:
        """Keep the pieces of an exhibit; returns the names of their files."""
        with writing("the exhibit", self.folder):
            kept = [(self.keep("exhibits", p.data, ENDINGS[p.media_type]), ENDINGS[p.media_type]) for p in shown.pieces]
        return tuple(f"{sha256}.{ending}" for sha256, ending in kept)

    def pieces(self, record: FilmRecord) -> tuple[Piece, ...]:
        """What is shown of a film.

        Raises:
            RecordError: a piece is not there, or not what its name says.
        """
        kinds, found = {ending: kind for kind, ending in ENDINGS.items()}, []
        for name in record.exhibit:
            path = self.folder / "exhibits" / name
            sha256, _, ending = name.partition(".")
            content = path.read_bytes() if path.is_file() and not set("/\\") & set(name) else b""
            if hashlib.sha256(content).hexdigest() != sha256 or ending not in kinds:
                raise _changed("what is shown", path)
            found.append(Piece(kinds[ending], content))
        return tuple(found)

    def write(self, record: FilmRecord) -> FilmRecord:
        """Keep a film's record; what is there of another film of that name goes to `earlier/`."""
        path = self._path(record.id)
        with writing("the verdict", path):
            if path.is_file() and not record.same_as(before := self.read(record.id)):
                write_atomic(self._earlier(before), path.read_bytes())
            write_atomic(path, record.model_dump_json(indent=2) + "\n")
        return record

    def find(self, record: FilmRecord) -> FilmRecord:
        """The record of this film with its votes so far, or the given one where there are none of it."""
        for path in (self._path(record.id), self._earlier(record)):
            if path.is_file() and record.same_as(before := self._checked(path)):
                return before
        return record

    def read(self, id: str) -> FilmRecord:
        """A film's record, checked against its own hashes.

        Raises:
            RecordError: it is damaged, or changed since.
        """
        return self._checked(self._path(id))

    def _checked(self, path: Path) -> FilmRecord:
        record = _parsed(path, FilmRecord)
        if record.criteria.sha256 != record.criteria_sha256:
            raise _changed("its criteria", path)
        for vote in record.votes:
            if hashlib.sha256(vote.text.encode()).hexdigest() != vote.sha256:
                raise _changed("a vote", path)
        try:
            record.answers()
        except JudgeError as cause:
            raise _changed("a vote", path) from cause
        return record

    def all(self) -> Iterator[FilmRecord]:
        """Every record, by name."""
        for path in sorted((self.folder / "verdicts").glob("*.json")):
            yield self._checked(path)

    def _earlier(self, record: FilmRecord) -> Path:
        name = f"{_safe(record.id)}-{record.film_sha256[:12]}-{record.subject_sha256[:12]}.json"
        return self.folder / "earlier" / name

    def _path(self, id: str) -> Path:
        return self.folder / "verdicts" / f"{_safe(id)}.json"


def outside(folder: Path) -> Path:
    """A folder for verdicts, where no builder reads.

    Raises:
        RecordError: it lies in a run, a campaign or a project.
    """
    folder = folder.expanduser().resolve()
    for at in (folder, *folder.parents):
        if held := next((name for name in INSIDE if (at / name).is_file()), ""):
            raise RecordError(
                f"verdicts would lie where builders read: {at} holds {held}", place=str(folder),
                next_move="leave --out away (they go to your data folder), or name a folder outside of projects",
            )  # fmt: skip
    return folder


def _safe(id: str) -> str:
    """A scenario's id as the name of a file."""
    plain = "".join(c if c.isalnum() or c in "-_" else "_" for c in id)[:60]
    return plain if plain == id else f"{plain}-{hashlib.sha256(id.encode()).hexdigest()[:8]}"


def _parsed(path: Path, kind: type[R]) -> R:
    try:
        return kind.model_validate_json(path.read_bytes())
    except (OSError, ValidationError) as cause:
        raise RecordError(
            f"it cannot be read: {str(cause).splitlines()[0]}",
            place=str(path),
            next_move="restore it, or judge it again",
        ) from cause


def _changed(what: str, path: Path) -> RecordError:
    return RecordError(
        f"{what} is not as it was recorded", place=str(path), next_move="restore the file, or remove it and judge again"
    )
