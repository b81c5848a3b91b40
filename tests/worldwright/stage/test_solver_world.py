"""A plan that asks for a solver beside the engine, from its text to an accepted world that is proved again."""

from pathlib import Path

import pytest

import whole_runs
from worldwright.draft.writing import write_program
from worldwright.scan import tools as scan
from worldwright.stamp import tools as stamp

pytestmark = [pytest.mark.gl, pytest.mark.slow]
PLAN = Path(__file__).parents[1] / "world" / "duck-in-a-bath.md"


def test_a_declared_solver_floats_a_duck_to_acceptance(tmp_path: Path) -> None:
    run = whole_runs.approved(PLAN, tmp_path / "duck")
    assert write_program(run, actor="code").open_places == (), "the solver's work is none of the program's"
    assert "def control" not in run.program.read_text(encoding="utf-8")
    recording = whole_runs.filmed(run)
    water = recording.channels("basin")
    assert water["volume"][-1] == pytest.approx(0.1 + 0.02 * 3.0)
    assert water["level"][-1] - water["level"][0] > 0.12
    assert recording.pos[-1, 0, 2] == pytest.approx(water["level"][-1], abs=0.005)
    scanned = scan.scan(str(run.folder))
    assert scanned.ok, scanned.text()
    (acted,) = scanned.acting
    assert acted.startswith("force on duck, ") and "declared: Archimedes" in acted
    assert scan.expect(str(run.folder)).ok
    whole_runs.reviewed(run)
    whole_runs.accepted(run)
    for rebuild in (False, True):
        proved = stamp.verify(str(run.folder), timeout_s=60, rebuild=rebuild)
        assert (proved.state, proved.mode) == ("proved", "bitwise"), proved.text()
