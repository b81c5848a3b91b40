"""The steps of a run are one list: README, `go`, `stamp status` and the gates use its words in its order."""

import re
from itertools import chain
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.go import Accepting
from worldwright.model.errors import PlanError
from worldwright.model.evidence.build_steps import STEPS
from worldwright.model.plan import plan_text
from worldwright.stamp import tools as stamp

README = (Path(__file__).parents[2] / "README.md").read_text(encoding="utf-8")


def test_a_walk_takes_them_all():
    assert tuple(chain(*Accepting.groups)) == STEPS


@pytest.mark.gl
@pytest.mark.slow
def test_a_build_parses_a_plan_once_for_each_content(tmp_path: Path, small_plan: str, monkeypatch: pytest.MonkeyPatch):
    """As it was written, and with its poses: however many folders hold a copy, and however many steps ask."""
    parsed: list[str] = []

    class Reader(plan_text._Reader):
        def __init__(self, text, *more):
            parsed.append(text)
            super().__init__(text, *more)

    monkeypatch.setattr(plan_text, "_Reader", Reader)
    plan_text._parsed.cache_clear()
    unfilmed = small_plan.replace("mode: cameras", "mode: none")
    (tmp_path / "plan.md").write_text(unfilmed, encoding="utf-8")
    words = ["go", str(tmp_path / "plan.md"), "--run", str(tmp_path / "run"), "--approve", "--accept"]
    done = CliRunner().invoke(cli.main, words)
    assert done.exit_code == 0, done.output
    assert parsed == [unfilmed, (tmp_path / "run" / "plan.md").read_text(encoding="utf-8")]
    copies = sorted((tmp_path / "run").rglob("plan.md"))
    assert len(copies) > 5 and len({plan_text.read_plan(path).file for path in copies}) == len(copies)
    assert len(parsed) == 2


def test_a_fault_is_told_of_the_file_that_it_is_in(tmp_path: Path, small_plan: str):
    broken = small_plan.replace("time_step: 0.002", "time_step: soon")
    for name in ("one.md", "two.md"):
        (tmp_path / name).write_text(broken, encoding="utf-8")
        with pytest.raises(PlanError) as refused:
            plan_text.read_plan(tmp_path / name)
        assert refused.value.place == str(tmp_path / name)
        assert {finding.file for finding in refused.value.findings} == {str(tmp_path / name)}


def test_the_status_tells_of_them_all(planned: Path):
    assert tuple(step.name for step in stamp.status(str(planned)).steps) == STEPS


def test_the_readme_draws_them_and_says_what_each_guarantees():
    assert "plan.md ─ " + " ─ ".join(STEPS) in README
    told = [name for row in re.findall(r"^\| \*\*(.+?)\*\* \|", README, re.MULTILINE) for name in row.split(", ")]
    assert tuple(told) == STEPS


def test_a_plan_with_an_open_pose_is_checked_and_not_placed(planned: Path, tmp_path: Path):
    text = (planned / "plan.md").read_text(encoding="utf-8")
    open_again = re.sub(r"position: \{[^}]*\}", "position: TO_CLARIFY", text, count=1)
    assert open_again != text
    (tmp_path / "plan.md").write_text(open_again, encoding="utf-8")
    found = {step.name: step for step in stamp.status(str(tmp_path)).steps}
    assert found["place"].status == "fails"
    assert found["place"].next_move.startswith("worldwright place resolve")
