"""A world written by a coding harness without a person: started in a folder of its own, watched, and moved in when it ends.

Each session is `authors/xx/<world>/N/`: `transcript.jsonl` (what it printed), `errors.txt`, `told.json` (how it ended, written
before anything is moved, so that a session that came to its end is never paid again), `process` (whom to end, should the worker and
`author_watch` die).
"""

import os
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path
from typing import IO

from worldkit.files import write_json

from ..model.evidence.run import Run
from ..model.frozen import Frozen
from ..stage import family
from . import author_folder, author_watch
from .author_folder import AuthorError
from .author_talk import Talk
from .author_words import Author
from .campaign_file import Campaign
from .campaign_store import Begun, Store
from .world_row import Written

LOOK_S = 0.25
"""How often it is looked at."""
LAST = 400
"""Characters of what it said that stand in a row."""


class Told(Frozen):
    """How a session ended."""

    kind: str = ""
    """Why its world is none, as a code; empty: it came to its end."""
    said: str = ""
    next_move: str = ""
    seconds: float = 0.0


def write(store: Store, begun: Begun, world: str, prompt: str, deadline: float) -> None:
    """Have a world written, unless it was; its run folder is in its place afterwards, also what a failed author left.

    Args:
        store: the campaign's folder.
        begun: the campaign.
        world: its address.
        prompt: what is asked of the author.
        deadline: monotonic, s; whoever is at it then is ended.

    Raises:
        AuthorError: the author did not come to its end, or left no plan; `code` is the kind.
    """
    stop(store, world)
    session = _last(store, world)
    told = _told(session)
    if session is None or told is None or told.kind:
        session = store.author(world) / str(_number(session) + 1)
        _set_aside(store, world, session)
        began = time.monotonic()
        kind, said, move = _session(session, begun, prompt, deadline)
        told = Told(kind=kind, said=said, next_move=move, seconds=round(time.monotonic() - began, 3))
        write_json(session / "told.json", told.model_dump(mode="json"))
    _move_in(session, store, world)
    if told.kind:
        raise AuthorError(told.kind, told.said, str(session), told.next_move)
    talk = Talk(session / "transcript.jsonl", _author(begun)).read(whole=True)
    if unpriced := _unpriced(talk, begun.campaign):  # with prices it goes on, and is not paid again
        raise AuthorError(unpriced[0], unpriced[1], str(session), unpriced[2])
    if not Run(store.world(world)).plan.is_file():
        raise AuthorError(
            "no_plan",
            f"it ended without a plan; its last words: {_cut(talk.last) or '(none)'}",
            str(session),
            "read its transcript",
        )


def written(store: Store, begun: Begun, world: str) -> Written:
    """What all sessions of a world came to, those that were broken off among them."""
    author = begun.campaign.author
    sessions = _sessions(store, world)
    if author is None or not sessions:
        return Written(author=author.harness if author else "")
    costs = [Talk(session / "transcript.jsonl", author).read(whole=True).cost() for session in sessions]
    money = [cost.usd for cost in costs if cost.usd is not None]
    transcript = sessions[-1] / "transcript.jsonl"
    return Written(
        author=author.harness,
        tokens_read=sum(cost.read for cost in costs),
        tokens_written=sum(cost.written for cost in costs),
        usd=round(sum(money), 6) if money else None,
        author_seconds=sum(told.seconds for session in sessions if (told := _told(session))),
        transcript=transcript.relative_to(store.folder).as_posix() if transcript.is_file() else "",
    )


def worlds(store: Store) -> list[str]:
    """Every world that an author was begun for, whether or not it has a row."""
    return sorted(path.name for path in (store.folder / "authors").glob("*/*"))


def stop(store: Store, world: str) -> bool:
    """End the session of a world that a worker left behind, with all that it started; whether one lived."""
    session = _last(store, world)
    return session is not None and author_watch.stop(session)


def _session(session: Path, begun: Begun, prompt: str, deadline: float) -> tuple[str, str, str]:
    """One session; its kind of failure, what is said of it, and the next move, all empty when it came to its end."""
    author, room = _author(begun), session / "project"
    talk = Talk(session / "transcript.jsonl", author)
    try:
        author_folder.make(room, author.harness, session.parents[3])
        program = shutil.which(author.program or talk.harness.PROGRAM)
        if program is None:
            said = f"{talk.harness.NAME} is not here: no program `{author.program or talk.harness.PROGRAM}` on the path"
            return "harness_missing", said, f"npm install -g {talk.harness.PACKAGE}, or name it in `author.program`"
        words = talk.harness.headless(prompt, author.model, room, begun.campaign.per_world.usd)
        with talk.path.open("wb") as out, (session / "errors.txt").open("wb") as errors:
            watch = _started(session, [program, *author.options, *words], room, out, errors)
    except AuthorError as error:
        return error.code, str(error.cause), error.next_move
    except (OSError, ValueError) as error:  # no such program any more, too long a line, a NUL in the prompt
        return "harness_missing", f"{talk.harness.NAME} cannot be started: {error}", "see `author.program`"
    try:
        cut = _watched(watch, talk, begun, room, deadline)
    finally:
        assert watch.stdin is not None
        watch.stdin.close()  # its word to end the harness
        if not family.ends_within(watch, 3 * author_watch.ENDS_S):
            watch.kill()
        watch.wait()
        author_watch.stop(session)  # where the watch was itself killed
    return cut or _how(watch.returncode, talk, session, begun.campaign)


def _started(
    session: Path, words: list[str], room: Path, out: IO[bytes], errors: IO[bytes]
) -> "subprocess.Popen[bytes]":
    """The harness, below a process that ends with us."""
    from ..contract import harnesses

    inside = {name for harness in harnesses.known().values() for name in harness.SHELL_SETS}
    return subprocess.Popen(
        [sys.executable, "-P", "-m", author_watch.__name__, str(session), *words],
        cwd=room,
        stdin=subprocess.PIPE,
        stdout=out,
        stderr=errors,
        start_new_session=True,
        env={name: value for name, value in os.environ.items() if name not in inside} | {"PWD": str(room)},
    )


def _watched(
    process: "subprocess.Popen[bytes]", talk: Talk, begun: Begun, room: Path, deadline: float
) -> tuple[str, str, str] | None:
    """Wait for its end; why it was not waited for, else None."""
    limits = begun.campaign.per_world
    while not family.ends_within(process, LOOK_S):
        spent = talk.read().cost().usd
        if time.monotonic() > deadline:
            said = f"its author was not done within the {limits.seconds:g} s that a world may take"
            return "over_time", f"{said}; it last said: {_cut(talk.last) or '(nothing)'}", "raise per_world.seconds"
        if limits.usd is not None and spent is not None and spent > limits.usd:
            return _over_usd(spent, limits.usd)
        if not talk.ended and (unpriced := _unpriced(talk, begun.campaign)):  # who says that it is done is let end
            return unpriced
        if limits.runs is not None and _runs(room) > limits.runs:
            return "over_runs", f"its author ran its physics more than {limits.runs} times", "raise per_world.runs"
        if talk.too_long:
            return "rubbish", "it printed more than any session does", "read its transcript"
    return None


def _how(code: int, talk: Talk, session: Path, campaign: Campaign) -> tuple[str, str, str]:
    """How a session that ended by itself ended."""
    talk.read(whole=True)
    errors, most_usd = _tail(session / "errors.txt"), campaign.per_world.usd
    if not (session / author_watch.PROCESS).exists():
        return "harness_missing", f"{talk.harness.NAME} cannot be started: {_cut(errors)}", "see `author.program`"
    name, move = talk.harness.NAME, f"read authors/{session.parent.parent.name}/{session.parent.name}/{session.name}"
    if talk.over_usd:
        return "over_usd", f"{name} ended it for what it cost: {_cut(talk.last)}", "raise per_world.usd"
    spent = talk.cost().usd
    if most_usd is not None and spent is not None and spent > most_usd:  # of some it is not known before
        return _over_usd(spent, most_usd)
    if talk.login(errors if code or not talk.events else ""):
        said = _cut(talk.wrong or errors)
        return "not_logged_in", f"{name} has no account here: {said}", f"log in: start `{talk.harness.PROGRAM}` once"
    if code:
        how = f"ended with status {code}"
        if code < 0 or code - 128 in (signal.SIGKILL, signal.SIGTERM, signal.SIGSEGV, signal.SIGABRT, signal.SIGBUS):
            how = f"was killed (signal {-code if code < 0 else code - 128})"
        why = _cut(talk.wrong or errors)
        return "harness_died", f"{name} {how}{f': {why}' if why else ', and said nothing'}", move
    if not talk.events:
        said = "printed nothing" if not talk.rubbish else "printed what is none of its events"
        return "rubbish", f"{name} {said}: {_cut(_tail(talk.path) or errors)}", move
    if talk.wrong:
        return "harness_failed", f"{name} could not go on: {_cut(talk.wrong)}", move
    return "", "", ""


def _unpriced(talk: Talk, campaign: Campaign) -> tuple[str, str, str] | None:
    """Why no limit of US dollars would ever end it: it counts tokens, and tells no money for them."""
    cost = talk.cost()
    limited = campaign.per_world.usd is not None or campaign.budget.usd is not None
    if not limited or cost.usd or not (cost.read or cost.written) or talk.author.prices is not None:
        return None
    told = "no money" if cost.usd is None else "0 US dollars"
    said = (
        f"{talk.harness.NAME} tells {told} for {cost.read + cost.written:,} tokens: no limit of `usd` would ever end it"
    )
    return (
        "no_prices",
        said,
        "give `author.prices: {read, written}`, US dollars for a million tokens, or leave `usd` out",
    )


def _over_usd(spent: float, most: float) -> tuple[str, str, str]:
    return "over_usd", f"its author cost {spent:.4g} of {most:g} US dollars", "raise per_world.usd"


def _move_in(session: Path, store: Store, world: str) -> None:
    """Bring the world that was written into its place, and free the author's project."""
    room = session / "project"
    runs = [path.parent for path in (room / "runs").glob("*/plan.md")] or list((room / "runs").glob("[!.]*/"))
    target = store.world(world)
    if runs and not target.exists():
        target.parent.mkdir(parents=True, exist_ok=True)
        max(runs, key=lambda path: path.stat().st_mtime_ns).rename(target)
    if room.is_dir() and any((room / "runs").glob("[!.]*")):
        (room / "runs").rename(session / "others")  # it began several: nothing that was written is lost
    shutil.rmtree(room, ignore_errors=True)


def _set_aside(store: Store, world: str, session: Path) -> None:
    """Put what an earlier author left beside the new session, which begins with nothing."""
    session.mkdir(parents=True)
    if store.world(world).exists():
        store.world(world).rename(session / "before")


def _author(begun: Begun) -> Author:
    assert begun.campaign.author is not None
    return begun.campaign.author


def _sessions(store: Store, world: str) -> list[Path]:
    return sorted((p for p in store.author(world).glob("[0-9]*") if p.name.isdigit()), key=_number)


def _last(store: Store, world: str) -> Path | None:
    return next(reversed(_sessions(store, world)), None)


def _number(session: Path | None) -> int:
    return int(session.name) if session else 0


def _told(session: Path | None) -> Told | None:
    try:
        return Told.model_validate_json((session / "told.json").read_bytes()) if session else None
    except (OSError, ValueError):
        return None


def _runs(room: Path) -> int:
    return sum(1 for _ in room.glob("runs/*/evidence/*/physics*/result.json"))


def _cut(said: str) -> str:
    text = " ".join(said.split())
    return text if len(text) <= LAST else f"{text[:LAST]}…"


def _tail(path: Path) -> str:
    """The end of what was printed, without what no terminal shows."""
    try:
        with path.open("rb") as stream:
            stream.seek(max(0, path.stat().st_size - LAST))
            text = stream.read(LAST).decode(errors="replace")
    except OSError:
        return ""
    return "".join(c for c in text if c.isprintable() or c.isspace())
