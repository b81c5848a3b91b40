"""Try a run's film before its physics: described and drawn once, on a world that stands still for as long as it will last.

What a film may not ask for (a name that there is not, a number that is none, too much of anything) is told with its line then,
and not after minutes of physics. What a film reckons from how things move may fail here without fault: that is told, and no finding.
"""

import tempfile
from pathlib import Path

from worldkit.files import write_atomic, write_json

from ..model import companions
from ..model.errors import CallOverError, JobError, NotFoundError
from ..model.evidence.reports import EvidenceKey
from ..model.evidence.run import Run
from . import first_look, gates, one_frame, processes
from .short_runs import engine

SIZE = (64, 36)
TRAJECTORY = "trajectory"
LIMITS = (
    "timed_out", "out_of_memory", "out_of_cpu_time", "too_much_output", "too_many_processes", "too_many_files", "disk_full",
    "not_writable", "killed", "internal", "refused", "cancelled",
)  # fmt: skip
"""Codes of failures that say what was lacking, and not whose fault that is."""
NEEDS = "needs_recording"
"""Code of a failure that may be the missing motion's."""

LAID = ("meta.json", "complete.json", "*.arrows", "*.json", "*.npz")


def tried(run: Run, key: EvidenceKey | None) -> None:
    """Try it on the world of the bundle pass, or else on one that is built for this.

    Raises:
        JobError: the film fails, with its line; code `NEEDS` where the missing recording may be why.
        PlanError, GateError, NotFoundError: there is no program yet, or its world is not to be had.
        CallOverError: the client's call ended first.
    """
    with tempfile.TemporaryDirectory(prefix="worldwright-trial-") as folder:
        here = Path(folder)
        try:
            _world(run, key, here)
        except CallOverError:
            raise
        except (JobError, companions.CompanionError) as failure:
            raise NotFoundError(failure.cause, place=failure.place, next_move=failure.next_move) from failure
        one_frame.draw_frame(run, here, 0.0, SIZE, True, (), unmoved=True)


def _world(run: Run, key: EvidenceKey | None, here: Path) -> None:
    """Lay the world, its facts and a recording of its start into the folder `here`."""
    bundle = run.evidence(key) / "bundle" if key is not None and gates.passed(run, key, "bundle") else None
    if bundle is None or not all((bundle / name).is_file() for name in (first_look.WORLD, first_look.FACTS)):
        first_look.built(run, here)
    else:
        for name in (first_look.WORLD, first_look.FACTS):
            write_atomic(here / name, (bundle / name).read_bytes())
    given = [here / name for name in (first_look.WORLD, first_look.FACTS)]
    words = ["unmoved", "--world", str(given[0]), "--program", str(given[1])]
    if rows := processes.declared(run.plan):  # where media lie that solvers move
        write_json(here / processes.INPUTS, rows)
        given.append(here / processes.INPUTS)
        words += ["--inputs", str(given[-1])]
    laid = engine(words, given, LAID)
    for name, content in laid.items():
        if isinstance(content, bytes):
            write_atomic(here / TRAJECTORY / name, content)


def is_films(failure: JobError) -> bool:
    """Whether a failure while it was described or drawn is the film's own: it has its line, or is none of what was lacking."""
    name = Path(failure.place.rpartition(":")[0] or failure.place).name
    return name == "film.py" or (name != "simulation.py" and failure.code not in LIMITS)
