"""An approval is of the plan and of the model files that it names: either one changed needs a new one."""

import shutil
from pathlib import Path

import pytest

from worldwright.draft.writing import write_program
from worldwright.lint import tools as lint
from worldwright.model.errors import GateError
from worldwright.model.evidence import approval
from worldwright.model.evidence.run import Run
from worldwright.place.tools import resolve
from worldwright.stage import tools as stage
from worldwright.stamp import tools as stamp

MODELS = Path(__file__).parents[1] / "draft" / "models"


@pytest.fixture
def run(tmp_path: Path) -> Run:
    folder = tmp_path / "chests"
    (folder / "parts").mkdir(parents=True)
    shutil.copy(MODELS / "plan.md", folder)
    shutil.copy(MODELS / "arm.urdf", folder)
    shutil.copy(MODELS / "chest.xml", folder / "parts")
    (folder / "prompt.md").write_text("Two chests close.\n", encoding="utf-8")
    assert resolve(folder / "plan.md").ok
    return Run(folder)


def step(run: Run) -> tuple[str, str]:
    (found,) = [s for s in stamp.status(str(run.folder)).steps if s.name == "approve"]
    return found.status, found.detail


def test_a_model_file_changed_after_approval_needs_a_new_one(run: Run) -> None:
    with pytest.raises(GateError, match="not approved as it stands"):
        write_program(run)
    said = stamp.approve(str(run.folder), by="tester")
    assert "arm.urdf" in said.text() and "parts/chest.xml" in said.text()
    (entry,) = [e for e in run.entries() if e["action"] == "approve"]
    assert set(entry["models"]) == {"arm.urdf", "parts/chest.xml"}
    assert write_program(run).outcome == "written"
    assert lint.check_program([run.program], plan=run.plan).ok

    chest = run.folder / "parts" / "chest.xml"
    before = chest.read_text(encoding="utf-8")
    chest.write_text(before.replace("<mujoco", "<!-- heavier -->\n<mujoco", 1), encoding="utf-8")
    program = run.program.read_bytes()
    for call in (
        lambda: write_program(run),
        lambda: stage.start(str(run.folder)),
        lambda: stage.draft(str(run.folder)),
    ):
        with pytest.raises(GateError, match=r"parts/chest\.xml, which the plan names, changed") as caught:
            call()
        assert "approve again" in caught.value.next_move and caught.value.place.endswith("chest.xml")
    assert run.program.read_bytes() == program
    assert step(run)[0] == "missing" and "parts/chest.xml" in step(run)[1]

    stamp.approve(str(run.folder), by="tester")
    assert step(run)[0] == "holds" and write_program(run).outcome in ("written", "unchanged")
    # What was approved once is approved when it comes back, as with the plan itself.
    chest.write_text(before, encoding="utf-8")
    assert step(run)[0] == "holds"
    chest.unlink()
    assert step(run)[0] == "missing"


def test_an_approval_of_before_model_files_were_recorded_stands_for_plans_without_any() -> None:
    old = {"action": "approve", "plan_sha256": "a"}
    assert approval.standing([old], "a", {}) == old
    assert approval.standing([old], "a", {"arm.urdf": "1"}) is None
    assert approval.changed([old], "a", {"arm.urdf": "1"}) == ("arm.urdf",)
    assert approval.standing([old], "b", {}) is None and approval.changed([old], "b", {}) == ()
    assert approval.standing([{**old, "plan_sha256": ""}], "", {}) is None
