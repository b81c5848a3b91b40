"""A step of its own: what the sculpted files of a plan make is made once, before lint and the passes need it."""

import json
import re
import sys
import tempfile
from pathlib import Path

from worldkit.files import write_atomic, write_json
from worldkit.sculpt import keeping

from ..model.plan import imported
from ..model.plan.committed import Plan
from . import confined, plain
from .kept_sculpts import MOST_BYTES, Given, needed, place_of

MADE = "made.json"
"""In the place of a sculpted file: which of its things were made, and the keys of all of their shapes."""
KEYS = "keys.json"
KEY = re.compile("[0-9a-f]{24}")
WALL_S, MEMORY_MB = 120.0, 4096


def prepare(plan: Plan) -> int:
    """Make what the plan's files sculpt, as long as it is not kept whole; returns how many shapes were made.

    What fails leaves nothing: whatever uses the file tells why, with its line.
    """
    wanted: dict[str, set[str]] = {}
    for row in plan.assets:
        if imported.is_sculpt(row):
            wanted.setdefault(row.sculpted[0], set()).add(row.sculpted[1])
    folder = plan.folder
    return sum(_made(folder, file, names) for file, names in wanted.items() if folder and (folder / file).is_file())


def _made(root: Path, file: str, names: set[str]) -> int:
    files = needed(root, file)
    place = place_of(files)
    known = plain.read_json(place / MADE)
    before = known.get("names") or []
    if names <= {*before} and all(_whole(place, str(key)) for key in known.get("keys") or ()):
        return 0
    names |= {*before}
    with tempfile.TemporaryDirectory(prefix="worldwright-sculpt-") as folder:
        for path, content in files.items():
            write_atomic(Path(folder) / path, content)
        call = [sys.executable, "-s", "-m", "worldkit.sculpt.made_ahead", folder, file, "{out}", *sorted(names)]
        ended = confined.run(
            call, reads=(Path(folder),), wanted=(KEYS,), wall_s=WALL_S, memory_mb=MEMORY_MB, file_mb=512,
            sculpts=Given((place,), place),
        )  # fmt: skip
    if ended.status == "ended" and ended.exit_code == 0 and KEYS in ended.files:
        write_json(place / MADE, {"names": sorted(names), "keys": _listed(ended.files[KEYS])})
    return len(ended.sculpted)


def _listed(content: bytes) -> list[str]:
    """The keys that an author's process told."""
    try:
        return [key for key in json.loads(content) if isinstance(key, str) and KEY.fullmatch(key)]
    except (ValueError, TypeError, RecursionError):
        return []


def _whole(place: Path, key: str) -> bool:
    found = list(place.glob(f"{key}-*.npz")) if KEY.fullmatch(key) else []
    content = plain.read(found[0], MOST_BYTES) if len(found) == 1 else None
    return content is not None and found[0].name == keeping.name_of(key, content)
