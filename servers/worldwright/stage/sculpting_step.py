"""A step of its own: what the sculpted files of a plan make is made once, before lint and the passes need it.

What fails or takes too long does so once, too: a note with its own words lies in the place of exactly these sources, until they,
or the code that makes shapes, change.
"""

import json
import re
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from worldkit import kept_shapes
from worldkit.files import write_atomic, write_json

from ..model import call_time
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
        call = [sys.executable, "-s", "-m", "worldkit.sculpt.made_ahead", folder, file, "{out}", *sorted(names)]
        ended = confined.run(
            call, reads=(Path(folder),), wanted=(KEYS,), wall_s=WALL_S, memory_mb=MEMORY_MB, file_mb=512,
            sculpts=Given((place,), place), cancelled=cancelled,
        )  # fmt: skip
    if ended.status == "ended" and ended.exit_code == 0 and KEYS in ended.files:
        write_json(place / MADE, {"names": sorted(names), "keys": _listed(ended.files[KEYS])})
    elif ended.status == "ended" or (ended.status in OVER and call_time.left_s() > 0):  # the end of a call says nothing
        noted = {**tried, "code": ended.status, "message": _words(ended), "line": _line(file, ended.log)}
        if ended.status in OVER or (
            0 < ended.exit_code < KILLED and "Errno 28" not in ended.log
        ):  # else the machine did it
            write_json(place / FAILED, noted)
        raise _error(root / file, noted)
    return len(ended.sculpted)


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
