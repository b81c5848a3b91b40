"""Hand a recording to a film's author, ask it, and keep the films of the plan's cameras that need no new drawing."""

import shutil
import sys
from pathlib import Path
from typing import Any

from ..model.evidence import environment, pictures_of
from ..model.evidence.run import Run, sha256_file
from . import plain
from .job import Spec

PROGRAM = pictures_of.FILM
MOTION, FOLDER = "motion.npz", "film"


def lay_out(recording: Path, facts: Path, motion: Path) -> None:
    """Write the part of a recording that the film's author sees; `facts` is the program's `program.json`."""
    from worldengine.film import motion_facts
    from worldengine.recording import stored

    motion_facts.write(stored.open(recording), motion, plain.read_json(facts))


def call(program: Path, motion: Path, out: Path | str) -> list[str]:
    """The command line that lets the author describe the film."""
    words = [str(program), "--motion", str(motion), "--out", str(out)]
    return [sys.executable, "-s", "-m", "worldkit.filming.telling", *words]


def kept(run: Run, spec: Spec, out: Path) -> dict[str, Any]:
    """Take over the films of the plan's cameras that an earlier video pass of this key made by the same renderer.

    They show the recording, which no film can change, so another `film.py` costs only its own film. Returns what the
    earlier pass reported; it is empty when there is no such pass, or its films have changed.
    """
    target = run.evidence(spec.key) / "video"
    result = plain.read_json(target / "result.json")
    summary, files = result.get("summary") or {}, result.get("files") or {}
    by = summary.get("drawn_by") or result.get("film_sha256")
    if spec.force or not result.get("ok") or by != environment.film().sha256:
        return {}
    wanted = [f"{name}.mp4" for name in summary.get("cameras", ())]
    try:
        if not wanted or any(sha256_file(target / name) != files.get(name) for name in wanted):
            return {}
        for name in wanted:
            shutil.copyfile(target / name, out / name)
    except OSError:
        return {}
    return {name: value for name, value in summary.items() if name not in ("film", "trajectory_sha256")}
