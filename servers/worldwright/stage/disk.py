"""What a run takes on the disk, and what of it can be made again: pictures, recordings and jobs that nothing rests on.

Kept whole: the evidence of the program and plan as they stand, that of every accepted world, that which the next pass could
take over while the present program has none, the newest job of each pass and variant, and the frames of traced films that
the next final pass could go on with. Of an earlier key go the folders of its passes and trials; its reports stay, and its
program and plan, so that iterations are compared and gone back to. Of an earlier job goes what it drew or wrote; its log and
its state stay. A rehearsal, on which nothing rests, goes as a whole. Where there is no present program, nobody can say what of
the rest is earlier, and it stays. A folder is renamed before it is removed, so that a kill never leaves a part of it under its
name.
"""

import json
import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..model import json_object
from ..model.errors import GateError
from ..model.evidence import rehearsed
from ..model.evidence.reports import EvidenceKey, PassName
from ..model.evidence.run import SOURCE, Run
from ..model.frozen import Frozen
from ..model.storage import link_on_the_way, writing
from . import gates, refined
from .job import Job
from .launch import end_orphans, one_at_a_time, orphans

HEAVY = ("out", "frames", "author", "filming", "told", "tmp", "inputs/world.mjz")
"""What of an ended job may go; what it was given, its log and its state are small."""
REUSED: tuple[PassName, ...] = ("stills", "video")
"""Passes that take over pictures of an earlier key."""
STAMP = "stamp.json"
GOING = ".going-"
"""What is being removed is called so first."""
MB = 1e6


class Disk(Frozen):
    """The space that a run takes, MB."""

    total_mb: float
    evidence_mb: float = 0
    jobs_mb: float = 0
    accepted_mb: float = 0
    freeable_mb: float = 0
    """What `worldwright gc` would free."""

    def text(self) -> str:
        """One line."""
        parts = {"evidence": self.evidence_mb, "jobs": self.jobs_mb, "accepted": self.accepted_mb}
        said = ", ".join(f"{name} {mb:.1f}" for name, mb in parts.items() if mb >= 0.05)
        free = f"; `worldwright gc` frees {self.freeable_mb:.1f}" if self.freeable_mb >= 0.05 else ""
        return f"disk {self.total_mb:.1f} MB" + (f" ({said})" if said else "") + free


class Freed(Frozen):
    """What was removed of a run, or would be."""

    run: str
    removed: tuple[str, ...]
    """Relative to the run folder."""
    freed_mb: float
    dry: bool = False

    def text(self) -> str:
        """One line, and what went."""
        verb = "would free" if self.dry else "freed"
        return "\n".join([f"{self.run}: {verb} {self.freed_mb:.1f} MB", *(f"- {name}" for name in self.removed)])


def used(run: Run, key: EvidenceKey) -> Disk:
    """What a run takes now."""
    sizes = _sizes(run.folder)
    parts = {"evidence": run.folder / "evidence", "jobs": run.jobs, "accepted": run.accepted}
    size = {f"{name}_mb": sizes.get(str(path), 0) / MB for name, path in parts.items()}
    going = () if _under_way(run) else (path for path in freeable_of(run, key) if not link_on_the_way(run.folder, path))
    freeable = sum(sizes[str(path)] if str(path) in sizes else _size(path) for path in going) / MB
    return Disk(total_mb=sizes.get(str(run.folder), 0) / MB, freeable_mb=freeable, **size)


def free(run: Run, key: EvidenceKey | None, *, dry: bool) -> Freed:
    """Remove what can be made again; with `dry` only say what. Without a key: a rehearsal, and what a killed removal left.

    Raises:
        GateError: a job of the run, or its rehearsal, is under way, or a folder on the way to what would go is a link.
        StorageError: the folder cannot be written.
    """
    with writing("the run", run.folder), one_at_a_time(run), _held(run) as rehearsal:  # no job begins meanwhile
        if names := _under_way(run):
            busy = run.folder / names[0]
            its = busy.parents[1]
            raise GateError(
                f"{busy.name} is under way, and may read what would be removed",
                place=str(busy),
                next_move=f"wait for it (`worldwright stage wait {its}`), or `worldwright stage cancel {its}`",
            )
        if not dry:
            for one in (run, rehearsal) if rehearsal else (run,):
                end_orphans(one)  # what still writes would write on, into what is removed
        found = sorted(freeable_of(run, key))
        if links := [link for path in found if (link := link_on_the_way(run.folder, path))]:
            raise GateError(
                f"{links[0].relative_to(run.folder)} is a link: what lies behind it is not the run's to remove",
                place=str(links[0]),
                next_move=f"put the folder itself there, or remove the link: rm {links[0]}",
            )
        freed = sum(map(_size, found))
        for path in () if dry else found:
            _remove(path)
    removed = tuple(path.relative_to(run.folder).as_posix() for path in found)
    return Freed(run=run.name, removed=removed, freed_mb=freed / MB, dry=dry)


@contextmanager
def _held(run: Run) -> Iterator[Run | None]:
    """The rehearsal of a run, if it has one, in which nobody walks and no job begins meanwhile."""
    if (rehearsal := rehearsed.of(run.folder)) is None:
        yield None
        return
    with rehearsed.alone(rehearsal.folder) as nobody_else:
        if not nobody_else:
            raise GateError(
                "the run is being rehearsed",
                place=str(rehearsal.folder),
                next_move=f"wait until `worldwright stage rehearse {run.folder}` has answered",
            )
        with one_at_a_time(rehearsal):
            yield rehearsal


def freeable_of(run: Run, key: EvidenceKey | None) -> Iterator[Path]:
    """The files and folders that may go; links are left alone."""
    if (rehearsal := rehearsed.of(run.folder)) is not None:
        yield rehearsal.folder
    yield from _left(run.folder)
    kept = None if key is None else _kept(run, key)
    for folder in (run.folder / "evidence").glob("*"):
        yield from _left(folder)
        if kept is not None and folder.name not in kept and not folder.is_symlink():
            passes = (p for p in folder.glob("*") if not p.name.startswith(GOING) and p.name != SOURCE)
            yield from (p for p in passes if p.is_dir() and not p.is_symlink())
    newest, killed = set[tuple[str, str]](), {job.folder for job in orphans(run)}
    for job in Job.all(run):
        yield from _left(job.folder)
        if key is None:
            continue
        if (made := (job.spec.stage, job.spec.variant)) not in newest:
            newest.add(made)
            if job.folder in killed and not job.folder.is_symlink():
                yield from _torn(job)
        elif not job.folder.is_symlink():
            heavy = [*(job.folder / name for name in HEAVY), *job.folder.glob("replaced-*")]
            if job.spec.stage == "final":  # the next final pass goes on with them, and tidies
                traced = job.folder / refined.FOLDER, job.out if (job.out / refined.FOLDER).is_dir() else None
                heavy = [path for path in heavy if path not in traced]
            yield from (path for path in heavy if path.exists() and not path.is_symlink())


def _torn(job: Job) -> Iterator[Path]:
    """What a killed job wrote, which the next job of the run would remove; not the frames that a final pass goes on with."""
    frames = job.out / refined.FOLDER
    drawn = job.spec.stage == "final" and frames.is_dir()
    for path in (job.scratch, *(job.out.iterdir() if drawn else (job.out,))):
        if path != frames and path.exists() and not path.is_symlink():
            yield path


def _left(folder: Path) -> list[Path]:
    """What a removal that was killed has left in a folder."""
    return [] if folder.is_symlink() else [path for path in folder.glob(f"{GOING}*") if path.is_dir()]


def _remove(path: Path) -> None:
    """Remove a file or folder so that a kill at any moment leaves all of it, or nothing under its name."""
    if not path.is_dir():
        path.unlink()
        return
    if not path.name.startswith(GOING):
        path = path.rename(path.with_name(f"{GOING}{uuid.uuid4().hex[:8]}"))
    shutil.rmtree(path)


def _kept(run: Run, key: EvidenceKey) -> set[str] | None:
    """Keys whose evidence stays whole; None (all of them) where a stamp cannot be read.

    Of what cannot be read nobody can say that nothing rests on it: a key with a torn report of what it is, or of a pass, stays.
    One that never had such a report rests on nothing.
    """
    kept = {key.key, *(str(e.get("key")) for e in run.entries() if e.get("action") == "accept")}
    for folder in (run.folder, run.accepted, *run.earlier()):  # nothing rests on one that is damaged
        if (stamp := folder / STAMP).exists():
            try:
                kept.add(str(json.loads(stamp.read_bytes())["predicate"]["source"]["key"]))
            except (OSError, ValueError, KeyError, TypeError, RecursionError):
                return None
    evidence, same = run.folder / "evidence", ("program_sha256", "plan_sha256")
    for path in evidence.glob("*/key.json"):  # the present program and plan, seen in another environment
        said = json_object.read(path) or {}
        if all(said.get(name) == getattr(key, name) for name in same):
            kept.add(path.parent.name)
    for folder in evidence.glob("*"):
        reports = (folder / "key.json", *folder.glob("*/result.json"))
        if any(os.path.lexists(path) and json_object.read(path) is None for path in reports):
            kept.add(folder.name)
    if not (run.evidence(key) / "physics").is_dir():
        dated = [(_started(path), path.parents[1].name) for path in evidence.glob("*/physics/result.json")]
        kept |= {max(dated)[1]} if dated else set()
        kept |= {folder.parent.name for folder in gates.earlier(run, key)}
    for stage in REUSED:
        if not (run.evidence(key) / stage).is_dir():
            kept |= {folder.parent.name for folder in gates.earlier_pictures(run, stage)}
    return kept


def _started(result: Path) -> str:
    return str((json_object.read(result) or {}).get("started", ""))


def _under_way(run: Run) -> list[str]:
    """Jobs that have not ended, of the run and of its rehearsal, by their paths in the run folder."""
    rehearsal = rehearsed.of(run.folder)
    jobs = [*Job.all(run), *(Job.all(rehearsal) if rehearsal else ())]
    return [job.folder.relative_to(run.folder).as_posix() for job in jobs if not job.read().ended]


def _size(path: Path) -> int:
    """Bytes of a file, or of all files below a folder; links count for nothing."""
    if path.is_dir():
        return _sizes(path).get(str(path), 0)
    return path.stat().st_size if path.is_file() and not path.is_symlink() else 0


def _sizes(top: Path) -> dict[str, int]:
    """Bytes of all files below each folder of a tree, by its path, in one walk; links count for nothing."""
    found: dict[str, int] = {}
    for folder, folders, names in os.walk(top, topdown=False):
        total = sum(found.get(f"{folder}/{name}", 0) for name in folders)
        for name in names:
            with suppress(OSError):  # a running job may have removed it
                total += os.lstat(f"{folder}/{name}").st_size
        found[folder] = total
    return found
