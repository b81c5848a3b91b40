"""Take over an existing recording with the same motion key, in place of another simulation.

The rows are copied byte by byte and must hash as the earlier pass said they did; what describes the world (`meta.json`,
the drawn overlaps) is written anew, since looks and cameras may have changed.
"""

import hashlib
import json
import shutil
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from worldkit.files import write_json

if TYPE_CHECKING:
    import mujoco

    from .stored import Recording

RECORDING = "trajectory"
KEPT = (
    "steps",
    "trajectory_sha256",
    "inputs_sha256",
    "rows",
    "record_every",
    "warnings",
    "interventions",
    "max_penetration_m",
    "final_time",
)
"""Facts of the earlier pass that hold for this one, too."""


def reuse(
    passes: Sequence[Path],
    key: str,
    meta: dict[str, Any],
    model: "mujoco.MjModel",
    out: Path,
    size: tuple[int, int] | None,
) -> dict[str, Any] | None:
    """Take over the first recording of this motion key; None when none of them fits.

    Args:
        passes: folders of earlier physics passes of the same environment, each with `result.json`.
        key: the wanted motion key; an empty one fits nothing.
        meta: the description of the world now.
        model: the world now, before anything has run.
        out: the new recording.
        size: of its pictures, pixels, to look for drawn overlaps and cameras; None: nobody looks.

    Returns:
        The facts of the earlier pass that still hold, with `reused_from`, its folder's name under `evidence/`.
    """
    from . import stored

    for folder in passes if key else ():
        result, earlier = _json(folder / "result.json"), _json(folder / RECORDING / "meta.json")
        summary = result.get("summary") or {}
        if (
            not result.get("ok")
            or earlier.get("motion_key") != key
            or not (folder / RECORDING / "complete.json").exists()
        ):
            continue
        shutil.rmtree(out, ignore_errors=True)
        out.mkdir(parents=True)
        if not _copy(folder, out, result.get("files") or {}):
            shutil.rmtree(out, ignore_errors=True)
            continue
        # The recording's description of its columns stays; the world is described as it is now.
        write_json(out / "meta.json", {**earlier, **meta})
        if size is not None:
            describe_seen(model, stored.open(out), size, out)
        found = {name: summary[name] for name in KEPT if name in summary}
        return {**found, "reused_from": str(summary.get("reused_from") or folder.parent.name)}
    return None


def describe_seen(model: "mujoco.MjModel", recording: "Recording", size: tuple[int, int], out: Path) -> None:
    """Write what there is to see of a finished recording beside it: overlaps, surfaces that stand still, cameras."""
    from . import drawn_overlaps, standing_cameras, still_surfaces

    drawn_overlaps.write(model, recording, out)
    still_surfaces.write(model, out)
    standing_cameras.write(model, recording, size, out)  # last, as it moves the model's cameras


def _copy(folder: Path, out: Path, files: dict[str, str]) -> bool:
    """Copy the rows and the ending; returns False when a byte differs from what the earlier pass left."""
    wanted = {Path(name).name: sha256 for name, sha256 in files.items() if Path(name).parent == Path(RECORDING)}
    rows = [name for name in wanted if name.endswith(".arrows") or name == "complete.json"]
    try:
        for name in sorted(rows):
            shutil.copyfile(folder / RECORDING / name, out / name)
            with (out / name).open("rb") as stream:
                if hashlib.file_digest(stream, "sha256").hexdigest() != wanted[name]:
                    return False
    except OSError:
        return False
    return "state.arrows" in rows and "complete.json" in rows


def _json(path: Path) -> dict[str, Any]:
    try:
        value = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}
