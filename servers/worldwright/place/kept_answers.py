"""What the pre-roll answered once, kept: the same question to the same code has the same answer, half a second of a processor.

A plan is asked about at every step from the first check to acceptance, mostly unchanged. What is kept lies in the user's
cache, where only processes of ours write; whoever can write there can as well answer in the pre-roll's place.
"""

import contextlib
import hashlib
import json
import os
import re
import time
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from typing import Any

from worldkit import assets
from worldkit.files import write_atomic

from ..model import json_object
from ..model.evidence import environment
from ..model.evidence.file_hashes import below, cache_folder, sha256_of

MOST, MOST_BYTES = 1000, 64 << 20
"""Kept answers, and their bytes; those that were given longest ago go first."""
LARGEST = 1 << 20
"""A longer answer is not kept, bytes."""
ABANDONED_S = 3600.0
"""What is half written for so long, s, nobody will finish."""
ANSWER = re.compile(r"[0-9a-f]{64}\.json")
HALF_WRITTEN = re.compile(rf"\.{ANSWER.pattern}\..+")
"""The files of ours; whatever else lies in the folder, which the user may name, is not ours to remove."""
TOLD = frozenset({"contacts", "objects", "distances", "drops", "views"})
"""What every answer tells."""


def place_of(request: dict[str, Any]) -> Path | None:
    """Where the answer to a question is kept; None where it depends on files that no hash is taken of (models' meshes)."""
    if any(row["model"] for row in request["objects"]):
        return None
    used = sorted({row["asset"] for row in request["objects"] if row["asset"]})
    hashes = [sha256_of(f"placed-{name}", tuple((file, file.name) for file in assets.files(name))) for name in used]
    here = Path(__file__).parent
    code = sha256_of("place", (*below(here, ["*.py"]), (here.parent / "__init__.py", "../__init__.py")))
    told = json.dumps([request, hashes, code, _reader(), environment.current().model_dump(mode="json")], sort_keys=True)
    return _folder() / f"{hashlib.sha256(told.encode()).hexdigest()}.json"


def read(path: Path) -> dict[str, Any] | None:
    """A kept answer, which counts as just given; None where there is none that is whole."""
    answer = json_object.read(path)
    if answer is None or not answer.keys() >= TOLD:
        return None
    with contextlib.suppress(OSError):  # a cache that is only read answers too
        os.utime(path)
    return answer


def keep(path: Path, answer: bytes) -> None:
    """Keep an answer; where the cache cannot be written it costs time and nothing else."""
    if len(answer) > LARGEST:
        return
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomic(path, answer)
        _tidy(path.parent)


def _folder() -> Path:
    """`WORLDWRIGHT_PREROLLS`, else one in the cache."""
    named = os.environ.get("WORLDWRIGHT_PREROLLS")
    return Path(named) if named else cache_folder() / "prerolls"


def _reader() -> str:
    """The version of what reads files of meshes; the other packages are the environment's."""
    try:
        return version("trimesh")
    except PackageNotFoundError:
        return ""


def _tidy(folder: Path) -> None:
    with os.scandir(folder) as found:
        files = [(one.stat(), one) for one in found if one.is_file()]
    kept = 0
    answers = sorted((row for row in files if ANSWER.fullmatch(row[1].name)), key=lambda row: -row[0].st_mtime_ns)
    for number, (stat, one) in enumerate(answers):
        kept += stat.st_size
        if number >= MOST or kept > MOST_BYTES:
            Path(one).unlink(missing_ok=True)
    for stat, one in files:
        if HALF_WRITTEN.fullmatch(one.name) and stat.st_mtime < time.time() - ABANDONED_S:
            Path(one).unlink(missing_ok=True)
