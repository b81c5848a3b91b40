"""A step of its own: what the sculpted files of a plan make is made once, before lint and the passes need it.

What fails or takes too long does so once, too: a note with its own words lies in the place of exactly these sources, until they,
or the code that makes shapes, change.
"""

import errno
import json
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from worldkit import kept_shapes
from worldkit.files import write_atomic, write_json

from ..model.errors import JobError
from ..model.evidence import environment
from ..model.plan import imported
from ..model.plan.committed import Plan
from . import confined, plain
from .kept_sculpts import MOST_BYTES, Given, needed, place_of

MADE = "made.json"
"""In the place of a sculpted file: which of its things were made, and the keys of all of their shapes."""
FAILED = "failed.json"
"""Beside it: of which of its things the making failed, by which environment, and how."""
KEYS = "keys.json"
KEY = re.compile("[0-9a-f]{24}")
WALL_S, MEMORY_MB = 120.0, 4096
OVER, KILLED = ("timed_out", "out_of_memory"), 128
MACHINE = {errno.ENOSPC: "disk_full", errno.EDQUOT: "disk_full"}
"""The system's errors that are the machine's, and their codes: no disk space or quota is left to give."""
EITHER = {errno.EAGAIN: "too_many_processes", errno.ENOMEM: "out_of_memory"}
"""Those that are the machine's or the file's own, which asks for more processes or memory than it may have."""
LAST = re.compile(r"(?:\w+\.)*\w+: \[Errno (\d+)\]")
"""How the last line of a traceback begins that the system's error ended."""
ROOM = "free some disk space of this machine, then call it again"
FEWER = "let it start fewer processes, or ask for less memory at once; if it does neither, free memory of this machine and call again"
LESS = "take fewer `cells` and `texels` (64, 512), rows by `linear` or `radial`, no `within` of a large union; a first sheet without paint"


def prepare(plan: Plan, cancelled: Callable[[], bool] = lambda: False) -> int:
    """Make what the plan's files sculpt, as long as it is not kept whole; returns how many shapes were made.

    Raises:
        JobError: a file does not make what the plan names, now or the last time; the error has its line. Who cancels is told nothing.
    """
    wanted: dict[str, set[str]] = {}
    for row in plan.assets:
        if imported.is_sculpt(row):
            wanted.setdefault(row.sculpted[0], set()).add(row.sculpted[1])
    folder = plan.folder
    there = {file: names for file, names in wanted.items() if folder and (folder / file).is_file()}
    return sum(_made(folder, file, names, cancelled) for file, names in there.items() if folder)


def _made(root: Path, file: str, names: set[str], cancelled: Callable[[], bool]) -> int:
    files = needed(root, file)
    place = place_of(files)
    known = plain.read_json(place / MADE)
    before = known.get("names") or []
    if names <= {*before} and all(_whole(place, str(key)) for key in known.get("keys") or ()):
        return 0
    names |= {*before}
    tried = {"names": sorted(names), "environment": environment.current().sha256()}
    noted = plain.read_json(place / FAILED)
    if {name: noted.get(name) for name in tried} == tried:
        raise _error(root / file, noted)
    with tempfile.TemporaryDirectory(prefix="worldwright-sculpt-") as folder:
        for path, content in files.items():
            write_atomic(Path(folder) / path, content)
        call = [sys.executable, "-s", "-P", "-m", "worldkit.sculpt.made_ahead", folder, file, "{out}", *sorted(names)]
        ended = confined.run(
            call, reads=(Path(folder),), wanted=(KEYS,), wall_s=WALL_S, memory_mb=MEMORY_MB, file_mb=512,
            sculpts=Given((place,), place), cancelled=cancelled,
        )  # fmt: skip
    if ended.status == "ended" and ended.exit_code == 0 and KEYS in ended.files:
        # What is too large to be kept is made by whoever needs it, not by every look at the plan, too.
        keys = [key for key in _listed(ended.files[KEYS]) if _whole(place, key)]
        write_json(place / MADE, {"names": sorted(names), "keys": keys})
    elif ended.status in ("ended", *OVER):
        noted = {**tried, "code": ended.status, "message": _words(ended), "line": _line(file, ended.log)}
        if ended.status == "ended" and (number := _errno(ended.log)) in (MACHINE | EITHER):  # not surely the file's own
            move = ROOM if number in MACHINE else FEWER
            raise JobError(noted["message"], code=(MACHINE | EITHER)[number], place=str(root / file), next_move=move)
        if ended.status in OVER or 0 < ended.exit_code < KILLED:  # else something ended it from outside
            write_json(place / FAILED, noted)
        raise _error(root / file, noted)
    return len(ended.sculpted)


def _errno(log: str) -> int:
    """The system's error that the last traceback ends with; 0 where it ends with none."""
    found = LAST.match((log.strip().splitlines() or [""])[-1])
    return int(found[1]) if found else 0


def forget(root: Path, file: str) -> None:
    """Take back the note that a file cannot be made: it was, for a sheet."""
    (place_of(needed(root, file)) / FAILED).unlink(missing_ok=True)


def _words(ended: confined.Confined) -> str:
    """How the making of a file failed, in its own words where it had any."""
    if ended.status == "timed_out":
        return f"making what it sculpts took more than {WALL_S:g} s of processor time"
    if ended.status == "out_of_memory":
        return f"making what it sculpts took more than {MEMORY_MB / 1024:g} GB of memory"
    return (ended.log.strip().splitlines() or [f"it ended with status {ended.exit_code}"])[-1][:500]


def _line(file: str, log: str) -> int | None:
    """The last line of the file that a traceback passed."""
    lines = re.findall(rf'{re.escape(file)}", line ([0-9]{{1,6}})', log)
    return int(lines[-1]) if lines else None


def _error(file: Path, noted: dict[str, Any]) -> JobError:
    """What a note tells; its code is that of a program's own end where it ended by itself."""
    code, line = str(noted.get("code")), noted.get("line")
    return JobError(
        str(noted.get("message")),
        code="crashed" if code == "ended" else code,
        place=f"{file}:{line}" if line else str(file),
        next_move=f"correct it: worldwright sculpt sheet {file}" if code == "ended" else LESS,
    )


def _listed(content: bytes) -> list[str]:
    """The keys that an author's process told."""
    try:
        return [key for key in json.loads(content) if isinstance(key, str) and KEY.fullmatch(key)]
    except (ValueError, TypeError, RecursionError):
        return []


def _whole(place: Path, key: str) -> bool:
    found = list(place.glob(f"{key}-*.npz")) if KEY.fullmatch(key) else []
    content = plain.read(found[0], MOST_BYTES) if len(found) == 1 else None
    return content is not None and found[0].name == kept_shapes.name_of(key, content)
