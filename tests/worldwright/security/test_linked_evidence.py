"""Nothing of ours writes through a link that lies in a run: what is behind it is somebody else's. A run may itself lie behind one."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.errors import GateError
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage

Copy = Callable[[Path], Path]


@pytest.mark.parametrize("below", ["evidence", "evidence/KEY", "evidence/KEY/physics", "evidence/KEY/source"])
def test_evidence_behind_a_link_is_neither_written_nor_called_the_runs(
    reviewed: Path, copy: Copy, tmp_path: Path, below: str
) -> None:
    run, elsewhere = Run(copy(reviewed)), tmp_path / "elsewhere"
    key = run.evidence_key(environment.current().sha256())
    place = run.folder / below.replace("KEY", key.key)
    place.rename(elsewhere)
    place.symlink_to(elsewhere)
    before = {path: path.stat().st_mtime_ns for path in elsewhere.rglob("*")}
    calls: list[Callable[[], object]] = []
    if below != "evidence/KEY/physics":
        calls += [lambda: scan.scan(str(run.folder)), lambda: scan.expect(str(run.folder))]
        calls.append(lambda: run.keep(key, "lint", LintReport()))
    if below != "evidence/KEY/source":
        calls.append(lambda: stage.start(str(run.folder), stage="physics", force=True))
    for call in calls:
        with pytest.raises(GateError, match="is a link: what lies behind it is no evidence of this run"):
            call()
    assert {path: path.stat().st_mtime_ns for path in elsewhere.rglob("*")} == before


def test_a_run_in_a_folder_behind_a_link_keeps_its_reports(reviewed: Path, copy: Copy, tmp_path: Path) -> None:
    folder = copy(reviewed)
    (tmp_path / "runs").symlink_to(folder.parent)
    assert scan.scan(str(tmp_path / "runs" / folder.name)).ok
