"""The match that the skill of robots shows is a plan that stands, drafted whole; where its robot's wheel and policy are here."""

import shutil
from pathlib import Path

import pytest

from worldkit.robots import packaged
from worldwright.draft import draft
from worldwright.lint.tools import check_plan
from worldwright.model.plan.plan_text import parse_plan, read_plan
from worldwright.place.engine import resolve
from worldwright.scan.objectives.claims import EXPECTATIONS

CASE = Path(__file__).parents[2] / "skills/robots/references/twenty-four"
POLICY = next(
    (
        path
        for place in Path(__file__).parents
        if (path := place / "shared/data/policies/playground/t1_policy.onnx").is_file()
    ),
    None,
)


def test_twelve_against_twelve_are_claimed_to_stand():
    plan = parse_plan((CASE / "plan.md").read_text(encoding="utf-8")).plan
    players = [name for row in plan.assets for name in row.instances]
    (told,) = (row["end_upright"] for o in plan.objectives for row in o.expect if "end_upright" in row)
    given = EXPECTATIONS.find("end_upright").Given.model_validate(told)
    assert len(players) == 24 and set(given.parts) == set(players) and given.min_count == 22


if "t1" in packaged.found() and POLICY:

    @pytest.mark.slow
    def test_the_plan_stands_and_is_drafted_whole(tmp_path):
        shutil.copyfile(CASE / "plan.md", tmp_path / "plan.md")
        packaged.lay("t1", tmp_path / "t1")
        shutil.copyfile(POLICY, tmp_path / "t1/walk.onnx")
        assert [f.message for f in check_plan(tmp_path / "plan.md").findings] == []
        plan = read_plan(tmp_path / "plan.md").plan
        made = draft(plan, resolve(plan).scene)
        assert not made.open_places and made.source.count("robots.match(") == 1 and "control_every=10" in made.source
        assert made.source.count(": ((") >= 24, "a place for each player"
