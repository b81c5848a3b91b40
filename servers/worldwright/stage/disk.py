"""What a run takes on the disk, and what of it can be made again: pictures, recordings and jobs that nothing rests on.

Kept whole: the evidence of the program and plan as they stand, that of every accepted world, the recording that the next
pass could take over while the present program has none, and the newest job of each pass. Of an earlier key go the folders of
its passes and trials; its reports stay, and its program and plan, so that iterations are compared and gone back to. Of an
earlier job goes what it drew or wrote; its log and its state stay.
"""

import json
import os
import shutil
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path

from ..model.errors import GateError
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import SOURCE, Run
from ..model.frozen import Frozen
from ..model.storage import writing
from .job import Job

HEAVY = ("out", "frames", "author", "filming", "told", "tmp", "inputs/world.mjz")
"""What of an ended job may go; what it was given, its log and its state are small."""
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
    parts = {"evidence": run.folder / "evidence", "jobs": run.jobs, "accepted": run.accepted}
    size = {f"{name}_mb": _size(path) / MB for name, path in parts.items()}
    freeable = sum(map(_size, () if _under_way(run) else freeable_of(run, key))) / MB
    return Disk(total_mb=_size(run.folder) / MB, freeable_mb=freeable, **size)


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
            if path.is_dir():
                shutil.rmtree(path)
            else:
                path.unlink()
    removed = tuple(path.relative_to(run.folder).as_posix() for path in found)
    return Freed(run=run.name, removed=removed, freed_mb=freed / MB, dry=dry)


def freeable_of(run: Run, key: EvidenceKey) -> Iterator[Path]:
    """The files and folders that may go; links are left alone."""
    kept = _kept(run, key)
    for folder in (run.folder / "evidence").glob("*"):
        if kept is not None and folder.name not in kept and not folder.is_symlink():
            yield from (p for p in folder.glob("*") if p.is_dir() and not p.is_symlink() and p.name != SOURCE)
    newest: set[str] = set()
    for job in Job.all(run):
        if (stage := job.spec.stage) not in newest:
            newest.add(stage)
        elif not job.folder.is_symlink():
            heavy = [*(job.folder / name for name in HEAVY), *job.folder.glob("replaced-*")]
            yield from (path for path in heavy if path.exists() and not path.is_symlink())


def _kept(run: Run, key: EvidenceKey) -> set[str] | None:
    """Keys whose evidence stays whole; None (all of them) where a world stands accepted that the journal does not know."""
    accepted = {str(e.get("key")) for e in run.entries() if e.get("action") == "accept"}
    if not accepted and run.stamped.joinpath("stamp.json").exists():
        return None
    kept = {key.key, *accepted}
    if not (run.evidence(key) / "physics").is_dir():
        results = (run.folder / "evidence").glob("*/physics/result.json")
        dated = [(_started(path), path.parents[1].name) for path in results]
        kept |= {max(dated)[1]} if dated else set()
    return kept


def _started(result: Path) -> str:
    try:
        return str(json.loads(result.read_bytes()).get("started", ""))
    except (OSError, ValueError, AttributeError):
        return ""


def _under_way(run: Run) -> list[str]:
    return [job.folder.name for job in Job.all(run) if not job.read().ended]


def _size(path: Path) -> int:
    """Bytes of a file, or of all files below a folder; links count for nothing."""
    if not path.is_dir():
        return path.stat().st_size if path.is_file() and not path.is_symlink() else 0
    total = 0
    for folder, _, names in os.walk(path):
        for name in names:
            with suppress(OSError):  # a running job may have removed it
                total += Path(folder, name).lstat().st_size
    return total
