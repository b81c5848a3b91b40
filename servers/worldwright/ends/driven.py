"""What a drive leaves: driven again by its own stream in a clean process, it passes through the recorded rows, bit for bit.

    DRIVE/begun/begun.json, …            what is driven, by hash, signed with this machine's key before the first step
    DRIVE/world.mjz, plan.md, facts.json, inputs.json, commands.json    the same, and what could be commanded
    DRIVE/live/trajectory                the rows recorded live, at most ten a simulated second, and the stream
    DRIVE/events.jsonl                   who came, drove and left
    DRIVE/stream/inputs.arrows, edits.arrows    what was sent to the world, at the step where it took effect
    DRIVE/program.json                   the program's facts, with the time that was driven
    DRIVE/physics/trajectory             the whole recording, made by the replay: scan it, film it
    DRIVE/drive.json, stamp.dsse.json, stamp.pub    who drove it and what proves it, signed with this machine's key

A process that was killed leaves the stream up to the last row that was written; `finish` proves what there is.
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
    BEGINNING,
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

if TYPE_CHECKING:
    from worldengine.recording.stored import Recording

__all__ = ["EVENTS", "PHYSICS", "STATEMENT", "TRAJECTORY", "Driven", "find", "finish", "listed", "prove"]
PACE = ("why", "overruns", "worst_s", "lost_s", "jumps", "refused")


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


def finish(folder: Path) -> Driven:
    """Prove a drive that has ended, or was killed, and write what proves it.

    Raises:
        GateError: it still runs, is none of a run, began otherwise, nothing was driven, or the replay passes through other rows.
        JobError: the replay failed.
        StorageError: the folder cannot be written.
    """
    folder = drive_folder.checked(folder)
    with drive_folder.held(folder):
        return _finish(folder)


def _finish(folder: Path) -> Driven:
    drive_folder.begun(folder)
    live = drive_replay.recorded(folder)
    steps = drive_replay.steps_of(live)
    with writing("the drive", folder):
        _keep_stream(folder, live, steps)
        write_json(folder / "program.json", _program(folder, live, steps))
        for stale in (STATEMENT, signing.ENVELOPE, signing.PUBLIC):
            (folder / stale).unlink(missing_ok=True)
    predicate = _stated(folder, live, steps)
    subject = [
        {"name": name, "digest": {"sha256": sha256_file(folder / name)}} for name in LISTED if (folder / name).is_file()
    ]
    said = {
        "_type": TYPE,
        "subject": subject,
        "predicateType": PREDICATE,
        "predicate": predicate.model_dump(mode="json"),
    }
    with writing("the drive's statement", folder):
        write_json(folder / STATEMENT, said)
        if signing.check(folder / BEGINNING, Path(BEGUN).name).holder != "own":
            return _told(folder, predicate, "NOT SIGNED: this machine's key did not sign how it began")
        try:
            signing.sign(folder, STATEMENT, keyring.own())
        except signing.SigningError as cause:
            return _told(folder, predicate, f"NOT SIGNED: {cause.cause}")
    return _told(folder, predicate)


def prove(folder: Path) -> Driven:
    """Prove a finished drive again: every file and word as it was stated, the signature, and the replay; finish one that is not.

    Raises:
        GateError: something is not as it was stated, or the drive still runs.
        JobError: the replay failed.
        StorageError: the folder cannot be written.
    """
    folder = drive_folder.checked(folder)
    with drive_folder.held(folder):
        return _prove(folder) if (folder / STATEMENT).is_file() else _finish(folder)


def _prove(folder: Path) -> Driven:
    said = drive_folder.statement(folder)
    named = {row.name: row.digest.sha256 for row in said.subject}
    for name, digest in named.items():
        if name not in LISTED or not (folder / name).is_file() or sha256_file(folder / name) != digest:
            drive_folder.refuse(folder / name, f"{name[:80]} is not what the statement lists")
    if missing := {name for name in LISTED if (folder / name).is_file()} - set(named):
        drive_folder.refuse(folder, f"{', '.join(sorted(missing))} is not in the statement")
    if (held := signing.check(folder, STATEMENT)).holder == "broken":
        drive_folder.refuse(folder / signing.ENVELOPE, held.problem)
    live = drive_replay.recorded(folder)
    steps = drive_replay.steps_of(live)
    if drive_folder.facts(folder, "program.json") != _program(folder, live, steps):
        drive_folder.refuse(folder / "program.json", "program.json is not what was driven, for as long as it was")
    found = _stated(folder, live, steps, said.predicate.trajectory_sha256)
    for name in Predicate.model_fields:
        if (one := getattr(said.predicate, name)) != (other := getattr(found, name)):
            drive_folder.refuse(
                folder / STATEMENT, f"{name} is stated as {str(one)[:120]}, and comes out as {str(other)[:120]}"
            )
    return _told(folder, found)


def _stated(folder: Path, live: "Recording", steps: int, wanted: str = "") -> Predicate:
    """What a drive's statement says, found by driving it again; the replay is put into the folder.

    Args:
        folder, live, steps: the drive, its rows, its length.
        wanted: the trajectory that it must be, by hash, before anything is put anywhere.
    """
    from worldengine.recording import stored

    seconds = steps * live.time_step
    begun, driven_by = drive_folder.begun(folder), drive_folder.spans(folder, seconds)
    with tempfile.TemporaryDirectory(prefix="worldwright-drive-") as place:
        room = Path(place) / PHYSICS
        room.mkdir()
        whole = drive_replay.again(folder, room, int(live.meta["record_every"]))
        if wanted and whole.sha256 != wanted:
            drive_folder.refuse(folder, f"the replay moves otherwise: {whole.sha256[:16]}, not {wanted[:16]}")
        rows = drive_replay.compared(live, whole, steps)
        with drive_replay.sound(folder / STREAM):
            inputs = stored.inputs_digest(folder / STREAM)
        pace = drive_folder.facts(folder, "live/result.json") if (folder / "live/result.json").is_file() else {}
        found = Predicate(
            begun=begun, driven_by=driven_by, steps=steps,
            simulated_s=seconds, complete=live.complete, rows=rows, rows_live=len(live), trajectory_sha256=whole.sha256,
            inputs_sha256=inputs, pace={name: pace[name] for name in PACE if name in pace},
        )  # fmt: skip
        with writing("the recording of the drive", folder):
            shutil.rmtree(folder / PHYSICS, ignore_errors=True)
            shutil.copytree(room, folder / PHYSICS, dirs_exist_ok=True)
    return found


def _told(folder: Path, said: Predicate, unsigned: str = "") -> Driven:
    held = signing.check(folder, STATEMENT)
    return Driven(
        folder=str(folder), run=said.begun.run, driven_by=tuple(span.model_dump() for span in said.driven_by),
        simulated_s=said.simulated_s, complete=said.complete, rows=said.rows, rows_live=said.rows_live,
        trajectory_sha256=said.trajectory_sha256, inputs_sha256=said.inputs_sha256, signed=unsigned or held.text(),
        vouched=held.vouched,
    )  # fmt: skip


def _program(folder: Path, live: "Recording", steps: int) -> dict[str, Any]:
    """The program's facts with the time that was driven."""
    return {**drive_folder.facts(folder, "facts.json"), "duration": steps * live.time_step}


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
