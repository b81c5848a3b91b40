"""The stills of a run that show one recording, if they are drawn and as they were drawn."""

import json
from pathlib import Path
from typing import TYPE_CHECKING

from . import pictures_of
from .run import Run, sha256_file

if TYPE_CHECKING:
    from ..recording.stills import Stills

FOLDER, CAMERAS = "stills", "cameras.json"


def read(run: Run, evidence: Path, trajectory_sha256: str) -> "Stills | None":
    """The stills of this recording; None where there are none by the present renderer, or a file is not the one drawn."""
    from ..recording.stills import OnDisk, Stills, lenses

    folder = evidence / FOLDER
    try:
        result = json.loads((folder / "result.json").read_text(encoding="utf-8"))
        said = json.loads((folder / CAMERAS).read_text(encoding="utf-8"))
        if not result["ok"] or result["film_sha256"] != pictures_of.identity(run, "stills"):
            return None
        if result["summary"]["trajectory_sha256"] != trajectory_sha256:
            return None
        names = tuple(said["cameras"])
        files = (CAMERAS, *(f"{name}.png" for name in names))
        if any(sha256_file(folder / name) != result["files"][name] for name in files):
            return None
        known = lenses(said)
    except (OSError, ValueError, KeyError, TypeError):
        return None
    return Stills(known, OnDisk(folder, names))
