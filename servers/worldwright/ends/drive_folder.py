"""The folder of a live drive: what its files may say, who holds it, and that nothing in it leads elsewhere.

Anybody who can write the folder can have written them, so each is read by a schema, and what is a link is refused.
"""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal, NoReturn

from pydantic import ConfigDict, Field, FiniteFloat, NonNegativeInt, PositiveInt, ValidationError

from ..model import json_object, try_lock
from ..model.errors import GateError
from ..model.evidence.run import Run, sha256_file
from ..model.frozen import Frozen
from ..stage import plain

DRIVES, LIVE = "drives", "live"
"""The folder of a run's drives; in each, what was recorded live."""
BEGINNING, BEGUN = "begun", "begun/begun.json"
STATEMENT, EVENTS = "drive.json", "events.jsonl"
STREAM, PHYSICS, TRAJECTORY = "stream", "physics", "trajectory"
GIVEN = ("world.mjz", "plan.md", "facts.json", "inputs.json", "commands.json")
"""What there is of a drive before its first step."""
LISTED = (
    *GIVEN, "program.json", EVENTS, BEGUN, "begun/stamp.dsse.json", "begun/stamp.pub", "stream/inputs.arrows",
    "stream/edits.arrows", "live/result.json", "live/trajectory/meta.json", "live/trajectory/complete.json",
    "live/trajectory/state.arrows", "live/trajectory/inputs.arrows", "live/trajectory/edits.arrows",
)  # fmt: skip
"""What the statement lists, as far as it is there."""
TYPE, PREDICATE = "https://in-toto.io/Statement/v1", "urn:worldwright:drive:v1"
AGAIN = "drive again: worldwright live RUN"


class Begun(Frozen):
    """What is known before the first step, signed then."""

    drive: str
    """Name of the drive's folder."""
    run: str
    stamp_sha256: str
    """Of the stamp of an accepted world; else empty."""
    speed: FiniteFloat
    begun_at: str
    files: dict[str, str]
    """SHA-256 of each of `GIVEN`."""


class Span(Frozen):
    """A stretch of a drive and who drove it, by the name that was given."""

    driver: str
    where: str
    from_s: FiniteFloat
    to_s: FiniteFloat


class Pace(Frozen):
    """How the pace of the wall clock was kept, by the engine's own word; nothing of a process that was killed."""

    why: str = Field(default="", max_length=300)
    """Why it ended."""
    overruns: NonNegativeInt | None = None
    worst_s: FiniteFloat | None = None
    lost_s: FiniteFloat | None = None
    jumps: NonNegativeInt | None = None
    refused: NonNegativeInt | None = None


class Predicate(Frozen):
    """What a drive's statement says; `driven.stated` finds each of it anew."""

    begun: Begun
    driven_by: tuple[Span, ...]
    steps: PositiveInt
    simulated_s: FiniteFloat
    complete: bool
    rows: PositiveInt
    """Rows recorded live that the replay repeats bit for bit,"""
    rows_live: PositiveInt
    """of so many."""
    trajectory_sha256: str
    inputs_sha256: str
    pace: Pace
    witnessed: bool = False
    """Whether the process of the live world stated this; False where it was finished later, and then nobody signs."""


class _Digest(Frozen):
    sha256: str


class _Subject(Frozen):
    name: str
    digest: _Digest


class Statement(Frozen):
    """`drive.json`, an in-toto statement."""

    type: Literal["https://in-toto.io/Statement/v1"] = Field(alias="_type")
    subject: tuple[_Subject, ...]
    predicate_type: Literal["urn:worldwright:drive:v1"] = Field(alias="predicateType")
    predicate: Predicate


class _Told(Frozen):
    model_config = ConfigDict(frozen=True, extra="ignore")


class _Drives(_Told):
    what: Literal["drives"]
    name: str
    where: str
    from_s: FiniteFloat


class _Released(_Told):
    what: Literal["released"]
    to_s: FiniteFloat


class _Other(_Told):
    what: str


_EVENTS: dict[str, type[_Told]] = {"drives": _Drives, "released": _Released}


def checked(folder: Path) -> Path:
    """The folder, resolved, if it is one of RUN/drives and holds nothing but folders and plain files.

    Raises:
        GateError, NotFoundError: it is none.
    """
    if folder.is_symlink() or (folder := folder.resolve()).parent.name != DRIVES:
        refuse(folder, "this is no folder of a run's drives", f"name a folder of RUN/{DRIVES}/")
    Run.find(folder.parents[1])
    if (odd := next(plain.odd(folder), None)) is not None:
        refuse(folder / odd, "a link, or what is no plain file, has no place in a drive", "remove it, then prove again")
    return folder


@contextmanager
def held(folder: Path) -> Iterator[None]:
    """Hold the drive alone; a `GateError` while it runs, or somebody else proves it."""
    try:
        file = (folder / BEGUN).open("rb")
    except OSError as cause:
        refuse(folder / BEGUN, f"its beginning cannot be read: {cause.strerror}")
    with file:
        try:
            free = try_lock.taken(file.fileno())
        except OSError as cause:
            refuse(folder / BEGUN, f"it cannot be held: {cause.strerror}", "copy the run to a file system with locks")
        if not free:
            refuse(folder, "this drive still runs, or is proved by another process", "end it (Ctrl-C), then prove it")
        yield


def begun(folder: Path) -> Begun:
    """How it began; a `GateError` where it began otherwise than what lies there."""
    found: Begun = _read(folder / BEGUN, Begun)
    if found.drive != folder.name:
        refuse(folder / BEGUN, f"this is the beginning of another drive, {found.drive[:80]}")
    for name in GIVEN:
        if not (folder / name).is_file() or sha256_file(folder / name) != found.files.get(name):
            refuse(folder / name, f"{name} is not what the drive began with")
    return found


def apart(folder: Path, begun: Begun) -> str:
    """How the run that a drive lies in is another than the one that it began in; empty where it is the same."""
    run, found = Run(folder.parents[1]), list[str]()
    if run.name != begun.run:
        found.append(f"`{begun.run[:80]}` was driven, and it lies in `{run.name}`")
    stamp = run.stamped / "stamp.json"
    if begun.stamp_sha256 and (not stamp.is_file() or sha256_file(stamp) != begun.stamp_sha256):
        found.append("the accepted world that was driven is not the one that lies there now")
    plan = run.stamped / "plan.md" if begun.stamp_sha256 else run.plan
    if not plan.is_file() or sha256_file(plan) != begun.files.get("plan.md"):
        found.append("its plan is another than this run's")
    return "; ".join(found)


def statement(folder: Path) -> Statement:
    """Its statement; a `GateError` where there is none that makes sense."""
    found: Statement = _read(folder / STATEMENT, Statement)
    return found


def pace(folder: Path) -> Pace:
    """How its pace was kept; a `GateError` where what was written of it makes no sense."""
    path = folder / LIVE / "result.json"
    if not path.is_file():
        return Pace()
    said = facts(folder, f"{LIVE}/{path.name}")
    try:
        return Pace.model_validate({name: said[name] for name in Pace.model_fields if name in said})
    except ValueError as cause:
        refuse(path, f"{path.name} makes no sense: {_first(cause)}")


def spans(folder: Path, seconds: float) -> tuple[Span, ...]:
    """Who drove when, out of what was noted on the way; a last line that was torn by a kill tells nothing."""
    path, found = folder / EVENTS, list[Span]()
    try:
        lines = path.read_bytes().splitlines()
    except OSError:
        return ()
    for number, line in enumerate(lines, 1):
        try:
            told = _Other.model_validate(json.loads(line))
            said = _EVENTS.get(told.what, _Other).model_validate_json(line)
        except (ValueError, RecursionError) as cause:
            if number == len(lines) and not isinstance(cause, ValidationError):
                break
            refuse(path, f"line {number} makes no sense: {_first(cause)}")
        if isinstance(said, _Drives):
            found.append(Span(driver=said.name, where=said.where, from_s=said.from_s, to_s=seconds))
        elif isinstance(said, _Released) and found:
            found[-1] = found[-1].model_copy(update={"to_s": min(said.to_s, seconds)})
    return tuple(span for span in found if span.from_s <= seconds)


def facts(folder: Path, name: str) -> dict[str, Any]:
    """A JSON object of the folder; a `GateError` where it is none."""
    found = json_object.read(folder / name)
    if found is None:
        refuse(folder / name, f"{name} cannot be read, or holds no object")
    return found


def _read(path: Path, kind: Any) -> Any:
    try:
        return kind.model_validate_json(path.read_bytes())
    except (OSError, ValueError) as cause:
        refuse(path, f"{path.name} makes no sense: {_first(cause)}")


def _first(cause: Exception) -> str:
    """The first thing that is wrong."""
    if isinstance(cause, ValidationError):
        row = cause.errors(include_url=False, include_input=False)[0]
        return f"{'.'.join(map(str, row['loc']))[:80]}: {row['msg']}"
    return str(cause)[:200]


def refuse(place: Path, cause: str, next_move: str = "restore it as it was recorded, or " + AGAIN) -> NoReturn:
    """A `GateError`."""
    raise GateError(cause, place=str(place), next_move=next_move)
