"""Frames of a final pass outlive their job, so that the next one goes on where it ended, or was cut.

Each film has a set of its own, by the hash of its description: a slip in `film.py`, and the house's film that is drawn
meanwhile, cost none of the author's frames.
"""

import math
import shutil
from contextlib import suppress
from pathlib import Path
from typing import Any

from ..model.evidence.run import Run
from .job import Job

FOLDER = "frames"
MEMORY_MB = 6144
"""Tracing paths takes more memory than other passes."""
KEPT = 3
"""So many films have their frames kept besides the one that is drawn: a variant may be taken back."""


def arguments(minutes: float) -> tuple[str, ...]:
    """Words for the engine's command line."""
    return ("--minutes", f"{minutes:g}")


def put_aside(job: Job) -> None:
    """Keep the frames of a job that has ended, or was killed, beside its other files; they are no evidence."""
    drawn = job.out / FOLDER
    if job.spec.stage == "final" and drawn.is_dir() and not drawn.is_symlink():
        shutil.rmtree(job.folder / FOLDER, ignore_errors=True)
        drawn.rename(job.folder / FOLDER)


def carry_over(run: Run, job: Job, described: Path, recording: Path, world: Path) -> None:
    """Move the frames that the last final pass drew of this film, of a world's file, to where the new one goes on with them:
    those that were traced, and those that a plainer renderer drew, which are called by it too.

    Those of the last `KEPT` other films stay where they lie; older ones are removed.
    """
    from worldengine.film import refining
    from worldengine.recording import stored

    name = refining.named(described, stored.open(recording).shown_sha256, world)
    past = [other for other in Job.all(run) if other.spec.stage == "final" and other.folder != job.folder]
    sets = [path for other in past if other.read().ended for path in (other.folder / FOLDER).glob("*") if path.is_dir()]
    others: set[str] = set()
    for path in sorted(sets, key=_drawn_at, reverse=True):
        there, film = job.out / FOLDER / path.name, path.name.partition("-")[0]
        if film != name and (film in others or len(others) < KEPT):
            others.add(film)
        elif film == name and not there.exists() and not job.spec.force:
            there.parent.mkdir(parents=True, exist_ok=True)
            with suppress(OSError):  # another pass, which runs beside it, tidied them away
                path.rename(there)
        else:
            shutil.rmtree(path, ignore_errors=True)


def _drawn_at(path: Path) -> float:
    """When a set was last drawn into; before all others where another pass has just tidied it away."""
    try:
        return path.stat().st_mtime
    except OSError:
        return 0.0


def said(summary: dict[str, Any]) -> str:
    """What a final pass says of its frames; empty of any other pass."""
    if "taken_over" not in summary:
        return ""
    count, drawn, reckoned, samples = (summary[name] for name in ("frames", "drawn", "reckoned", "samples"))
    held = count - drawn - reckoned
    parts = [
        f"{drawn} of its {count} frames are drawn, with {samples['least']:g} to {samples['most']:g} samples a pixel"
    ]
    by = summary.get("renderer", {})
    if why := by.get("because"):
        parts.append(
            f"they are drawn by `{by['name']}`, since `{by['instead_of']}` failed ({why}); worldwright doctor tells more"
        )
    if takes_s := summary.get("tracing_takes_s"):
        parts.append(
            f"they are drawn by `{by['name']}`, since tracing a whole film takes about {max(1, math.ceil(takes_s / 60))} minutes: give so many at once"
        )
    parts += [f"{reckoned} are reckoned between them by how all that is seen moves"] if reckoned else []
    parts += [f"{held} show the nearest drawn one"] if held else []
    parts += [f"its puffs are left out ({summary['puffless']})"] if summary.get("puffless") else []
    parts += [f"none could be reckoned any more ({summary['unreckoned']})"] if summary.get("unreckoned") else []
    parts += (
        [f"{summary['taken_over']} stood already, from an earlier pass of this very film"]
        if summary["taken_over"]
        else []
    )
    if count > drawn:
        more = max(1, math.ceil(summary["rest_s"] / 60))
        parts.append(f"about {more} more minute{'s' if more > 1 else ''} would draw the rest")
    elif not summary["complete"]:
        parts.append("more minutes give each more samples")
    return "; ".join(parts)
