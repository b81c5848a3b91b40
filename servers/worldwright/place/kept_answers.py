"""What the pre-roll answered once, kept: the same question to the same code has the same answer, half a second of a processor.

A plan is asked about at every step from the first check to acceptance, mostly unchanged. What is kept lies in the user's
cache, where only processes of ours write; whoever can write there can as well answer in the pre-roll's place.
"""

import contextlib
import hashlib
import json
from pathlib import Path
from typing import Any

from worldkit import assets
from worldkit.files import write_atomic

from ..model.evidence import environment
from ..model.evidence.file_hashes import below, cache_folder, sha256_of

MOST = 1000
"""Kept answers; those that were given longest ago go first."""
MOST_BYTES = 1 << 20


def place_of(request: dict[str, Any]) -> Path | None:
    """Where the answer to a question is kept; None where it depends on files that no hash is taken of (models' meshes)."""
    if any(row["model"] for row in request["objects"]):
        return None
    used = sorted({row["asset"] for row in request["objects"] if row["asset"]})
    hashes = [sha256_of(f"placed-{name}", tuple((file, file.name) for file in assets.files(name))) for name in used]
    code = sha256_of("place", below(Path(__file__).parent, ["*.py"]))
    told = json.dumps([request, hashes, code, environment.current().model_dump(mode="json")], sort_keys=True)
    return cache_folder() / "prerolls" / f"{hashlib.sha256(told.encode()).hexdigest()}.json"


def read(path: Path) -> dict[str, Any] | None:
    """A kept answer, which counts as just given; None where there is none that can be read."""
    with contextlib.suppress(OSError, ValueError):
        answer = json.loads(path.read_bytes())
        path.touch()
        return answer if isinstance(answer, dict) else None
    return None


def keep(path: Path, answer: bytes) -> None:
    """Keep an answer; where the cache cannot be written it costs time and nothing else."""
    if len(answer) > MOST_BYTES:
        return
    with contextlib.suppress(OSError):
        path.parent.mkdir(parents=True, exist_ok=True)
        write_atomic(path, answer)
        old = sorted(path.parent.glob("*.json"), key=lambda one: -one.stat().st_mtime_ns)[MOST:]
        for one in old:
            one.unlink(missing_ok=True)
