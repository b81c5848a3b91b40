"""The cases that the skill of robots shows: a match whose plan stands and is drafted whole, where its robot's wheel and policy are here;
an arm and a drone (drafted whole in `test_driven_rows`) with films that show what they do.
"""

import runpy
import shutil
from pathlib import Path

import numpy as np
import pytest

from worldkit.filming import Film, Recorded
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


@pytest.mark.parametrize(
    ("case", "mover", "way"),
    [("mug-on-a-shelf", "mug", (-0.14, 0.32, 0.15)), ("drone-in-gusts", "cf21b", (1.5, 1, 1.4))],
)
def test_a_film_shows_the_whole_way_of_what_its_plan_moves(case, mover, way):
    plan = parse_plan((CASE.parent / case / "plan.md").read_text(encoding="utf-8")).plan
    last = plan.simulation_parameters.simulation_duration
    share = np.linspace(0.0, 1.0, 200)[:, None]
    told = Film(Recorded.rehearsal({mover: share * way}, duration=last))
    runpy.run_path(str(CASE.parent / case / "film.py"))["film"](told)
    facts, frames = told.description()
    assert len(facts["shots"]) == 3 and frames["time"].max() == pytest.approx(last, abs=0.1)


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
