"""Hand a recording to a film's author, and ask it what the film is to show."""

import sys
from pathlib import Path

from ..model.evidence import pictures_of
from . import plain

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
