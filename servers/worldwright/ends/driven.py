"""What a drive leaves: driven again by its own stream in a clean process, it passes through the recorded rows, bit for bit.

    DRIVE/begun/begun.json, …            what is driven, by hash, signed with this machine's key before the first step
    DRIVE/world.mjz, plan.md, facts.json, inputs.json, commands.json    the same, and what could be commanded
    DRIVE/live/trajectory                the rows recorded live, at most ten a simulated second, and the stream
    DRIVE/events.jsonl                   who came, drove and left
    DRIVE/stream/inputs.arrows, edits.arrows    what was sent to the world, at the step where it took effect
    DRIVE/program.json                   the program's facts, with the time that was driven
    DRIVE/physics/trajectory             the whole recording, made by the replay: scan it, film it
    DRIVE/drive.json, stamp.dsse.json, stamp.pub    who drove it and what proves it, signed with this machine's key

Only the process that ran the world signs, at its end, what it saw (`witness`). One that was killed leaves the stream up to the
last row that was written; `prove` proves what there is, and says that nobody signed it.
"""

import shutil
import tempfile
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_json

from ..model.errors import GateError, NotFoundError
from ..model.evidence.run import sha256_file
from ..model.frozen import Frozen
from ..model.printable import line
from ..model.storage import writing
from ..stamp import keyring, signing
from . import drive_folder, drive_replay
from .drive_folder import (
    BEGUN,
    DRIVES,
    EVENTS,
    LISTED,
    PHYSICS,
    PREDICATE,
    STATEMENT,
    STREAM,
    TRAJECTORY,
    TYPE,
    Predicate,
)  # fmt: skip
from .witness import Witness

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording

__all__ = ["EVENTS", "PHYSICS", "STATEMENT", "TRAJECTORY", "Driven", "checked", "find", "finish", "listed", "prove"]
SEALING = ".sealing"
"""Where a statement is signed before it is one."""


class Driven(Frozen):
    """A drive, proved."""

    folder: str
    run: str
    driven_by: tuple[dict[str, Any], ...]
    """Each stretch: `driver` by the name that was given, `where`, `from_s`, `to_s`."""
    simulated_s: float
    complete: bool
    """False where the process was killed, or the world blew up: what was written until then counts."""
    rows: int
    """Rows recorded live that the replay repeats bit for bit,"""
    rows_live: int
    """of so many; those between rest on the last one, which is always compared."""
    trajectory_sha256: str
    inputs_sha256: str
    signed: str
    """Who signed, or why nobody did."""
    vouched: bool
    """Whether a key that is known here signed it."""
    apart: str = ""
    """How the run that it lies in is another than the one that was driven; empty: it is the same."""

    @property
    def exit_code(self) -> int:
        """0, or 3 where it is proved, but by no known key."""
        return 0 if self.vouched else 3

    def text(self) -> str:
        """The drive as a person reads it."""
        by = ", ".join(
            f"{line(row['driver'])} ({row['from_s']:.1f} to {row['to_s']:.1f} s, {line(row['where'])})"
            for row in self.driven_by
        )
        whole = "" if self.complete else "; it was killed or blew up, and this is what it had kept"
        rows = f"all {self.rows}" if self.rows == self.rows_live else f"{self.rows} of {self.rows_live}"
        return (
            f"{line(self.run)}: {self.simulated_s:.2f} s driven by {by or 'nobody'}{whole}\n"
            f"  proved      the replay repeats {rows} rows recorded live, bit for bit\n"
            f"  trajectory  {self.trajectory_sha256}\n  inputs      {self.inputs_sha256}\n  {self.signed}\n"
            f"{f'  NOT OF THIS RUN AS IT IS: {line(self.apart)}{chr(10)}' if self.apart else ''}"
            f"  kept in     {self.folder}\n"
            f"  next: worldwright scan scan {self.folder}/{PHYSICS}/{TRAJECTORY}, or worldwright drive film {self.folder}"
        )


def find(name: Path | str) -> Path:
    """The folder of a drive, or of the newest drive of a run.

    Raises:
        NotFoundError: it is neither; the known drives are listed.
    """
    path = Path(name)
    if (path / BEGUN).is_file():
        return path.resolve()
    for root in (path, Path("runs") / path, Path("examples") / path):
        if found := listed(root):
            return found[-1].resolve()
    raise NotFoundError(
        f"there is no drive `{name}`", next_move=f"worldwright live {name}, or name a folder of RUN/{DRIVES}/"
    )


def listed(run: Path) -> list[Path]:
    """The drives of a run in which something was driven, oldest first."""
    return sorted(path for path in (run / DRIVES).glob("*") if (path / BEGUN).is_file() and _moved(path))


def _moved(folder: Path) -> bool:
    if (folder / STATEMENT).is_file():
        return True
    with suppress(GateError):
        return drive_replay.steps_of(drive_replay.recorded(folder)) > 0
    return False


def finish(folder: Path, witness: Witness) -> Driven:
    """Prove a drive at its end, and sign it: what only the process that ran it can do.

    Raises:
        GateError: it still runs, is none of a run, began otherwise, nothing was driven, or the replay passes through other rows.
        JobError: the replay failed.
        StorageError: the folder cannot be written.
    """
    folder = drive_folder.checked(folder)
    with drive_folder.held(folder):
        return _finish(folder, witness)


def _finish(folder: Path, witness: Witness | None = None) -> Driven:
    drive_folder.begun(folder)
    live = drive_replay.recorded(folder)
    steps = drive_replay.steps_of(live)
    with writing("the drive", folder):
        for stale in (STATEMENT, signing.ENVELOPE, signing.PUBLIC):
            (folder / stale).unlink(missing_ok=True)
        _keep_stream(folder, live, steps)
        _write_program(folder, live, steps)
    listed = {name: sha256_file(folder / name) for name in LISTED if (folder / name).is_file()}
    unsigned = witness.contradicts(listed) if witness else "it was finished later"
    predicate = _stated(folder, live, steps, witnessed=not unsigned)
    said = {
        "_type": TYPE,
        "subject": [{"name": name, "digest": {"sha256": digest}} for name, digest in listed.items()],
        "predicateType": PREDICATE,
        "predicate": predicate.model_dump(mode="json"),
    }
    failed = _sealed(folder, said)
    return _told(folder, predicate, unsigned or failed)


def _sealed(folder: Path, said: dict[str, Any]) -> str:
    """Sign the statement of a live run beside its place, then put it there; returns why it is not signed, if it is not."""
    unsigned, room = "", folder / SEALING
    with writing("the drive's statement", folder):
        shutil.rmtree(room, ignore_errors=True)
        room.mkdir()
        write_json(room / STATEMENT, said)
        if said["predicate"]["witnessed"]:
            try:
                signing.sign(room, STATEMENT, keyring.own())
            except signing.SigningError as cause:
                unsigned = cause.cause
        _put(folder)
    return unsigned


def _put(folder: Path) -> None:
    """Put a statement into its place, last, when its signature lies there: after a kill the next `prove` goes on here."""
    for name in (signing.PUBLIC, signing.ENVELOPE, STATEMENT):
        if (made := folder / SEALING / name).is_file():
            made.replace(folder / name)
    shutil.rmtree(folder / SEALING, ignore_errors=True)


def prove(folder: Path) -> Driven:
    """Prove a finished drive again: every file and word as it was stated, the signature, and the replay.

    One that its live run did not finish is finished, unsigned: nobody here saw who drove it.

    Raises:
        GateError: something is not as it was stated, or the drive still runs.
        JobError: the replay failed.
        StorageError: the folder cannot be written.
    """
    folder = drive_folder.checked(folder)
    with drive_folder.held(folder):
        if not (folder / STATEMENT).is_file() and (folder / SEALING / STATEMENT).is_file():
            with writing("the drive's statement", folder):
                _put(folder)
        return _prove(folder) if (folder / STATEMENT).is_file() else _finish(folder)


def _prove(folder: Path) -> Driven:
    said, live, steps = _as_stated(folder)
    found = _stated(folder, live, steps, said.witnessed, said.trajectory_sha256)
    _same(folder, said, found.model_dump())
    return _told(folder, found)


def checked(folder: Path) -> Driven:
    """What is stated of a finished drive, held against its files, its signature and what was recorded live, without the replay.

    Raises:
        GateError: something is not as it was stated, or it is not finished.
    """
    folder = drive_folder.checked(folder)
    if not (folder / STATEMENT).is_file():
        drive_folder.refuse(folder, "this drive is not proved yet", f"worldwright drive prove {folder}")
    return _told(folder, _as_stated(folder)[0])


def _as_stated(folder: Path) -> "tuple[Predicate, Recording, int]":
    """What is stated, as far as it is told without the replay; the rows recorded live, and their steps."""
    said = drive_folder.statement(folder)
    named = {row.name: row.digest.sha256 for row in said.subject}
    for name, digest in named.items():
        if name not in LISTED or not (folder / name).is_file() or sha256_file(folder / name) != digest:
            drive_folder.refuse(folder / STATEMENT, f"{name[:80]} is not what the statement lists")
    if missing := {name for name in LISTED if (folder / name).is_file()} - set(named):
        drive_folder.refuse(folder, f"{', '.join(sorted(missing))} is not in the statement")
    if (held := signing.check(folder, STATEMENT)).holder == "broken":
        drive_folder.refuse(folder / signing.ENVELOPE, held.problem)
    live = drive_replay.recorded(folder)
    steps = drive_replay.steps_of(live)
    if drive_folder.facts(folder, "program.json") != _program(folder, live, steps):
        drive_folder.refuse(folder / "program.json", "program.json is not what was driven, for as long as it was")
    _same(folder, said.predicate, _known(folder, live, steps))
    return said.predicate, live, steps


def _same(folder: Path, said: Predicate, found: dict[str, Any]) -> None:
    stated = said.model_dump()
    for name, other in found.items():
        if (one := stated[name]) != other:
            drive_folder.refuse(
                folder / STATEMENT, f"{name} is stated as {str(one)[:120]}, and comes out as {str(other)[:120]}"
            )


def _known(folder: Path, live: "Recording", steps: int) -> dict[str, Any]:
    """What a drive's statement says, as far as it is told without the replay."""
    from worldengine.recording import stored

    seconds = steps * live.time_step
    with drive_replay.sound(folder / STREAM):
        inputs = stored.inputs_digest(folder / STREAM)
    found = {"begun": drive_folder.begun(folder).model_dump(), "steps": steps, "simulated_s": seconds}
    spans = tuple(span.model_dump() for span in drive_folder.spans(folder, seconds))
    pace = drive_folder.pace(folder).model_dump()
    return found | {
        "driven_by": spans, "complete": live.complete, "rows_live": len(live), "inputs_sha256": inputs, "pace": pace,
    }  # fmt: skip


def _stated(folder: Path, live: "Recording", steps: int, witnessed: bool, wanted: str = "") -> Predicate:
    """What a drive's statement says, found by driving copies of its files again; the replay is put into the folder.

    Args:
        folder, live, steps: the drive, its rows, its length.
        witnessed: whether the process of the live world states it.
        wanted: the trajectory that it must be, by hash, before anything is put anywhere.
    """
    known = _known(folder, live, steps)
    with tempfile.TemporaryDirectory(prefix="worldwright-drive-") as place:
        given, room = Path(place) / "given", Path(place) / PHYSICS
        room.mkdir()
        _copies(folder, given, known, live, steps)
        whole = drive_replay.again(folder, given, room, int(live.meta["record_every"]))
        if wanted and whole.sha256 != wanted:
            drive_folder.refuse(folder, f"the replay moves otherwise: {whole.sha256[:16]}, not {wanted[:16]}")
        rows = drive_replay.compared(live, whole, steps)
        found = Predicate(**known, rows=rows, trajectory_sha256=whole.sha256, witnessed=witnessed)
        with writing("the recording of the drive", folder):
            shutil.rmtree(folder / PHYSICS, ignore_errors=True)
            shutil.copytree(room, folder / PHYSICS, dirs_exist_ok=True)
    return found


def _copies(folder: Path, given: Path, known: dict[str, Any], live: "Recording", steps: int) -> None:
    """Copy what is driven again to where nobody else writes, and see that it is what the drive began with."""
    from worldengine.recording import stored

    shutil.copytree(folder / STREAM, given / STREAM)
    for name in ("world.mjz", "facts.json", "inputs.json"):
        shutil.copyfile(folder / name, given / name)
        if sha256_file(given / name) != known["begun"]["files"].get(name):
            drive_folder.refuse(folder / name, f"{name} is not what the drive began with")
    with drive_replay.sound(folder / STREAM):
        if stored.inputs_digest(given / STREAM) != known["inputs_sha256"]:
            raise ValueError("it changed while it was read")
    _write_program(given, live, steps)


def _told(folder: Path, said: Predicate, unsigned: str = "") -> Driven:
    held = signing.check(folder, STATEMENT)
    if not said.witnessed:
        why = unsigned or "it was finished later"
        signed = f"NOT SIGNED BY THE LIVE RUN: {why}, and anybody can have written who drove it"
    else:
        signed = f"NOT SIGNED: {unsigned}" if unsigned else held.text()
    return Driven(
        folder=str(folder), run=said.begun.run, driven_by=tuple(span.model_dump() for span in said.driven_by),
        simulated_s=said.simulated_s, complete=said.complete, rows=said.rows, rows_live=said.rows_live,
        trajectory_sha256=said.trajectory_sha256, inputs_sha256=said.inputs_sha256,
        signed=signed, vouched=said.witnessed and held.vouched, apart=drive_folder.apart(folder, said.begun),
    )  # fmt: skip


def _program(folder: Path, live: "Recording", steps: int) -> dict[str, Any]:
    """The program's facts with the time that was driven."""
    return {**drive_folder.facts(folder, "facts.json"), "duration": steps * live.time_step}


def _write_program(folder: Path, live: "Recording", steps: int) -> None:
    try:
        write_json(folder / "program.json", _program(folder, live, steps))
    except ValueError as cause:  # a number that is none, half a character
        drive_folder.refuse(folder / "facts.json", f"facts.json makes no sense: {str(cause)[:200]}")


def _keep_stream(folder: Path, live: "Recording", steps: int) -> None:
    """What was sent before the end of the drive."""
    stream = folder / STREAM
    shutil.rmtree(stream, ignore_errors=True)
    stream.mkdir()
    for name in ("inputs", "edits"):
        source = live.folder / f"{name}.arrows"
        if live.complete and source.is_file():
            shutil.copyfile(source, stream / source.name)
        elif not live.complete:
            with drive_replay.sound(live.folder):
                _cut(live, name, stream / source.name, steps)


def _cut(live: "Recording", name: str, path: Path, steps: int) -> None:
    """Write the rows of a table that took effect before a step."""
    import numpy as np
    import pyarrow as pa

    from worldengine.recording.columns import TABLES, arrow_schema

    table, schema = getattr(live, name), arrow_schema(TABLES[name])
    mine = np.asarray(table.step) < steps
    with pa.OSFile(str(path), "wb") as sink, pa.ipc.new_stream(sink, schema) as writer:
        if mine.any():
            arrays = [pa.array(np.asarray(table[field.name])[mine], field.type) for field in schema]
            writer.write_batch(pa.RecordBatch.from_arrays(arrays, schema=schema))
