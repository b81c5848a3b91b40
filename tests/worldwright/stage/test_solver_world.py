"""A plan that asks for a solver beside the engine, from its text to an accepted world that is proved again."""

from pathlib import Path

import pytest

from worldwright.draft.writing import write_program
from worldwright.lint import tools as lint
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run
from worldwright.place.tools import resolve
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp

pytestmark = [pytest.mark.gl, pytest.mark.slow]
PLAN = Path(__file__).parents[1] / "world" / "duck-in-a-bath.md"


def test_a_declared_solver_floats_a_duck_to_acceptance(tmp_path: Path) -> None:
    from worldengine.recording import stored

    folder = tmp_path / "duck"
    folder.mkdir()
    (folder / "plan.md").write_text(PLAN.read_text(encoding="utf-8"), encoding="utf-8")
    assert resolve(folder / "plan.md").ok
    assert not [f for f in lint.check_plan(folder / "plan.md").findings if f.severity == "error"]
    stamp.approve(str(folder), by="tester")
    run = Run(folder)
    assert write_program(run, actor="code").open_places == (), "the solver's work is none of the program's"
    assert "def control" not in run.program.read_text(encoding="utf-8")
    assert lint.check_program([run.program]).ok
    for name in ("physics", "stills", "video"):
        job = stage.start(str(folder), stage=name)
        while not job.ended:
            job = stage.wait(str(folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
    recording = stored.open(run.evidence(run.evidence_key(environment.current().sha256())) / "physics" / "trajectory")
    water = recording.channels("basin")
    assert water["volume"][-1] == pytest.approx(0.1 + 0.02 * 3.0)
    assert water["level"][-1] - water["level"][0] > 0.12
    assert recording.pos[-1, 0, 2] == pytest.approx(water["level"][-1], abs=0.005)
    scanned = scan.scan(str(folder))
    assert scanned.ok, scanned.text()
    (acted,) = scanned.acting
    assert acted.startswith("force on duck, ") and "declared: Archimedes" in acted
    assert scan.expect(str(folder)).ok
    stamp.describe(str(folder), by_measurement.describe(run))
    stamp.review(str(folder), by_measurement.review(run))
    assert stamp.accept(str(folder), timeout_s=60).ok
    for rebuild in (False, True):
        proved = stamp.verify(str(folder), timeout_s=60, rebuild=rebuild)
        assert (proved.state, proved.mode) == ("proved", "bitwise"), proved.text()
