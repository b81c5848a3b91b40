"""Runs from a plan of the tests to their films, as tools take them there."""

from pathlib import Path

from worldengine.recording import stored
from worldwright.lint import tools as lint
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run
from worldwright.place.tools import resolve
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp


def approved(plan: Path, folder: Path) -> Run:
    """A new run in `folder` of a plan that stands, and that a person has approved."""
    folder.mkdir()
    own = folder / "plan.md"
    own.write_text(plan.read_text(encoding="utf-8"), encoding="utf-8")
    assert resolve(own).ok
    assert not [f for f in lint.check_plan(own).findings if f.severity == "error"]
    stamp.approve(str(folder), by="tester")
    return Run(folder)


def filmed(run: Run) -> stored.Recording:
    """Lint the program of a run and make its passes; its recording."""
    assert lint.check_program([run.program]).ok
    for name in ("physics", "stills", "video"):
        job = stage.start(str(run.folder), stage=name)
        while not job.ended:
            job = stage.wait(str(run.folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
    return recorded(run)


def recorded(run: Run) -> stored.Recording:
    """The recording of what the run holds now."""
    return stored.open(run.evidence(run.evidence_key(environment.current().sha256())) / "physics" / "trajectory")


def reviewed(run: Run) -> None:
    """Describe and review what was measured, as nobody would look at it."""
    stamp.describe(str(run.folder), by_measurement.describe(run))
    stamp.review(str(run.folder), by_measurement.review(run))


def accepted(run: Run) -> None:
    """Accept a reviewed run; a busy machine goes on at the next call."""
    while not (told := stamp.accept(str(run.folder), timeout_s=60)).ok:
        assert told.state == "proving", told.text()
