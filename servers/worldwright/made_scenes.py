"""Which scene this machine wrote beside a run's report, and of which recording: what lies in a run folder says so of itself,
and anybody can write it there.

The note lies in the user's data, one small file a run folder, where no shell of an agent may write; a process knows besides
what it has just written.
"""

import hashlib
import json
from contextlib import suppress
from pathlib import Path

from worldkit.data_folders import data_root
from worldkit.files import write_json

_MADE: dict[str, str] = {}


def note(run: Path, scene: bytes, recording_sha256: str) -> None:
    """Remember what was written for a run folder; a user without a writable data folder has it for this process alone."""
    said = hashlib.sha256(scene).hexdigest()
    _MADE[said] = recording_sha256
    with suppress(OSError):
        write_json(_place(run), {"scene_sha256": said, "recording_sha256": recording_sha256})


def recording_of(run: Path, scene: bytes) -> str:
    """The hash of the recording that a run folder's scene was made of; empty where it is not the one that was written here."""
    said = hashlib.sha256(scene).hexdigest()
    if said in _MADE:
        return _MADE[said]
    try:
        noted = json.loads(_place(run).read_bytes())
        return str(noted["recording_sha256"]) if noted["scene_sha256"] == said else ""
    except (OSError, ValueError, KeyError, TypeError):
        return ""


def _place(run: Path) -> Path:
    return data_root() / "scenes" / f"{hashlib.sha256(str(run.resolve()).encode()).hexdigest()[:24]}.json"
