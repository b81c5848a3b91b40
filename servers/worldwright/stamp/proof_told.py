"""What `accept` tells while its proof goes on: how far it is, about how long it still takes, and what is at work beside it."""

from collections.abc import Iterator
from pathlib import Path
from typing import Literal

from ..model.errors import WorldwrightError
from .state import State

Part = Literal["proof", "again", "audit"]
PARTS: dict[Part, str] = {
    "proof": "the program, run once more",
    "again": "the world, driven again by its recorded inputs",
    "audit": "one part of its audits, made again",
}
"""What a proof is made of, in order."""


def line(state: State, work: Path, part: Part) -> str:
    """How far a proof is, in one line.

    Args:
        state: the run that is to be accepted.
        work: where it is proved.
        part: what was waited for when the time was over.
    """
    under_way = list(_under_way(work / "again" / "replay" if part == "again" else work / "proof", part == "audit"))
    said = under_way[-1].text().splitlines()[0] if under_way else "it begins"
    physics = state.passes["physics"].value
    each = physics.wall_s if physics is not None else 0.0
    left = under_way[-1].eta_s if under_way else None
    left = max(0.0, each - (under_way[-1].wall_s if under_way else 0.0)) if left is None else left
    later = list(PARTS)[list(PARTS).index(part) + 1 :]
    later = [
        name for name in later if name != "audit" or state.causes.value is not None or state.refine.value is not None
    ]
    then = f", then {' and '.join(PARTS[name] for name in later)}" if later else ""
    told = f"{PARTS[part]}: {said}{then}; about {left + len(later) * each:.0f} s in all"
    others = [job.text().splitlines()[0] for job in _beside(state)]
    return f"{told}; beside it, on the same processor: {'; '.join(others)}" if others else told


def _under_way(folder: Path, audits: bool) -> Iterator:
    """The jobs of a proof's folder that have not ended, oldest first."""
    from ..stage.tools import status

    try:
        stages = status(str(folder))
    except (WorldwrightError, OSError):  # nothing was begun there yet
        return
    yield from reversed([job for job in (stages.audits if audits else stages.jobs) if not job.ended])


def _beside(state: State) -> Iterator:
    """The run's own jobs that have not ended: a film, or worlds a little otherwise."""
    from ..stage.tools import status

    stages = status(str(state.run.folder))
    yield from (job for job in (*stages.jobs, *stages.audits) if job.state == "running")
