"""What a run takes on the disk, and what of it can be made again: pictures, recordings and jobs that nothing rests on.

Kept whole: the evidence of the program and plan as they stand, that of every accepted world, that which the next pass could
take over while the present program has none, the newest job of each pass and variant, and the frames of traced films that
the next final pass could go on with. Of an earlier key go the folders of its passes and trials; its reports stay, and its
program and plan, so that iterations are compared and gone back to. Of an earlier job goes what it drew or wrote; its log and
its state stay. A folder is renamed before it is removed, so that a kill never leaves a part of it under its name.
"""

import json
import os
import shutil
import uuid
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..model.errors import GateError
from ..model.evidence.reports import EvidenceKey, PassName
from ..model.evidence.run import SOURCE, Run
from ..model.frozen import Frozen
from ..model.storage import writing
from . import gates, refined
from .job import Job

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
    going = () if _under_way(run) else freeable_of(run, key)
    freeable = sum(sizes[str(path)] if str(path) in sizes else _size(path) for path in going) / MB
    return Disk(total_mb=sizes.get(str(run.folder), 0) / MB, freeable_mb=freeable, **size)


def free(run: Run, key: EvidenceKey, *, dry: bool) -> Freed:
    """Remove what can be made again; with `dry` only say what.

    Raises:
        GateError: a job of the run is under way.
        StorageError: the folder cannot be written.
    """
    from .launch import one_at_a_time

    with writing("the run", run.folder), one_at_a_time(run):  # no job begins meanwhile
        if names := _under_way(run):
            raise GateError(
                f"{names[0]} is under way, and may read what would be removed",
                place=str(run.jobs / names[0]),
                next_move=f"wait for it (`worldwright stage wait {run.folder}`), or `worldwright stage cancel {run.folder}`",
            )
        found = sorted(freeable_of(run, key))
        freed = sum(map(_size, found))
        for path in () if dry else found:
            _remove(path)
    removed = tuple(path.relative_to(run.folder).as_posix() for path in found)
    return Freed(run=run.name, removed=removed, freed_mb=freed / MB, dry=dry)


def freeable_of(run: Run, key: EvidenceKey) -> Iterator[Path]:
    """The files and folders that may go; links are left alone."""
    kept = _kept(run, key)
    for folder in (run.folder / "evidence").glob("*"):
        yield from _left(folder)
        if kept is not None and folder.name not in kept and not folder.is_symlink():
            passes = (p for p in folder.glob("*") if not p.name.startswith(GOING) and p.name != SOURCE)
            yield from (p for p in passes if p.is_dir() and not p.is_symlink())
    newest = set[tuple[str, str]]()
    for job in Job.all(run):
        yield from _left(job.folder)
        if (made := (job.spec.stage, job.spec.variant)) not in newest:
            newest.add(made)
        elif not job.folder.is_symlink():
            heavy = [*(job.folder / name for name in HEAVY), *job.folder.glob("replaced-*")]
            if job.spec.stage == "final":  # the next final pass goes on with them, and tidies
                traced = job.folder / refined.FOLDER, job.out if (job.out / refined.FOLDER).is_dir() else None
                heavy = [path for path in heavy if path not in traced]
            yield from (path for path in heavy if path.exists() and not path.is_symlink())


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
    """Keys whose evidence stays whole; None (all of them) where a stamp cannot be read."""
    kept = {key.key, *(str(e.get("key")) for e in run.entries() if e.get("action") == "accept")}
    for folder in (run.folder, run.accepted, *(run.folder / "earlier").glob("*")):
        if (stamp := folder / STAMP).exists():
            try:
                kept.add(str(json.loads(stamp.read_bytes())["predicate"]["source"]["key"]))
            except (OSError, ValueError, KeyError, TypeError, RecursionError):
                return None
    evidence, same = run.folder / "evidence", ("program_sha256", "plan_sha256")
    for path in evidence.glob("*/key.json"):  # the present program and plan, seen in another environment
        said = _said(path)
        if all(said.get(name) == getattr(key, name) for name in same):
            kept.add(path.parent.name)
    if not (run.evidence(key) / "physics").is_dir():
        dated = [(_started(path), path.parents[1].name) for path in evidence.glob("*/physics/result.json")]
        kept |= {max(dated)[1]} if dated else set()
        kept |= {folder.parent.name for folder in gates.earlier(run, key)}
    for stage in REUSED:
        if not (run.evidence(key) / stage).is_dir():
            kept |= {folder.parent.name for folder in gates.earlier_pictures(run, stage)}
    return kept


def _started(result: Path) -> str:
    return str(_said(result).get("started", ""))


def _said(path: Path) -> dict[str, Any]:
    """A JSON object; empty where there is none."""
    try:
        found = json.loads(path.read_bytes())
    except (OSError, ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def _under_way(run: Run) -> list[str]:
    return [job.folder.name for job in Job.all(run) if not job.read().ended]


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
