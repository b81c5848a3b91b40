"""Two rows that play one ball are a match: checked together, drafted as one, asked once a tick."""

from pathlib import Path

import pytest

import packaged_dogs
from worldkit.robots import packaged
from worldwright.draft import draft
from worldwright.lint.tools import check_plan
from worldwright.model.plan import imported
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.engine import resolve
from worldwright.stamp.gates.auto_approve import _chosen

TEXT = (Path(__file__).parents[1] / "world/walking_robot_plan.md").read_text(encoding="utf-8").replace("go2", "go1")
ROW = """- name: {name}
  type: mjcf
  filename: go1/go1.xml
  count: 2
  material: sole
  look: "{look}"
  walks: {{policy: go1/walk.onnx, gait: go1, speed_m_s: 0.8, plays: {{ball: {ball}, goal: [{goal}, 0]}}}}
"""
BALL = "- {name: ball, primitive: sphere, size: [0.2, 0.2, 0.2]}\n- {name: post, primitive: box, size: [0.1, 0.1, 0.1], fixed: true}"


def rows(**changed):
    """Both teams, with something changed of the second."""
    red = ROW.format(name="red", look="#d02020", ball="ball", goal=5)
    return red + ROW.format(**{"name": "blue", "look": "#2020d0", "ball": "ball", "goal": -5, **changed})


def plan_text(assets):
    head, rest = TEXT.split("## assets\n", 1)
    text = f"{head}## assets\n```yaml\n{assets}```\n## asset_dimensions{rest.split('## asset_dimensions', 1)[1]}"
    text = text.replace("## scene_objects\n", f"## scene_objects\n```yaml\n{BALL}\n```\n")
    text = text.replace("materials:", "masses: {ball: 0.4}\nmaterials:", 1)
    start, end = text.index("## objectives"), text.index("## implementation_steps")
    text = f"{text[:start]}## objectives\n```yaml\n- claim: The ball moves.\n  expect:\n    - moves: {{body: ball, min_m: 0.1}}\n```\n{text[end:]}"
    text = text.replace("assets: [go1]", "assets: [red, blue]").replace(
        "motion_expectations: [go1]", "motion_expectations: [ball]"
    )
    places = {"ball": (0, 0, 0.1), "post": (0, 9, 0.05)}
    places |= {f"{team}_{n}": (x, n, 0.2) for team, x in (("red", -2), ("blue", 2)) for n in (1, 2)}
    told = "".join(f"  {name}: {{x: {x}, y: {y}, z: {z}}}\n" for name, (x, y, z) in places.items())
    return text.replace("  go1: {x: 0.0, y: 0.0, z: 0.2125}\n", told)


@pytest.fixture
def write(tmp_path, monkeypatch):
    """A function that writes the plan of a match of small dogs, and returns where."""
    key = packaged_dogs.install(tmp_path / "site", monkeypatch).key
    packaged.lay(key, tmp_path / "run" / key)
    packaged_dogs.walk(tmp_path / "run" / key / "walk.onnx")

    def written(assets):
        path = tmp_path / "run/plan.md"
        path.write_text(plan_text(assets), encoding="utf-8")
        return path

    return written


def test_both_teams_are_drafted_as_one_match_that_is_asked_at_its_ticks(write):
    path = write(rows())
    assert not [f.message for f in check_plan(path).findings if f.severity == "error"]
    plan = read_plan(path).plan
    red, blue = plan.simulation_parameters.interventions
    assert len(red.bodies) == len(blue.bodies) == 24 and "after the ball ball towards the goal at (5 0)" in red.law
    made = draft(plan, resolve(plan).scene)
    assert not made.open_places and made.source.count("robots.") == 1
    assert made.source.count("BALL_MATCH(model, data)") == 1 and "control_every=10" in made.source
    called = made.source[made.source.index("BALL_MATCH = robots.match(") :]
    assert '"red_2": (5.0, 0.0)' in called and '"blue_1": (-5.0, 0.0)' in called and 'ball="ball"' in called
    marks = {name for name, _ in _chosen(plan)}
    assert {"assets.red.walks.plays", "assets.blue.walks.plays"} <= marks


def test_copies_are_read_once_and_each_has_names_of_its_own(write, monkeypatch):
    plan = read_plan(write(rows())).plan
    asked, real = [], imported._facts
    monkeypatch.setattr(imported, "_facts", lambda *given: asked.append(given[1]) or real(*given))
    found = {name: made for name, _, made in imported.all_of(plan)}
    assert set(asked) == {"red_1", "blue_1"} and set(found) == {"red_1", "red_2", "blue_1", "blue_2"}
    assert "red_2_FL_calf_joint" in found["red_2"].joints and "blue_2_FL_calf" in found["blue_2"].actuators
    assert found["red_2"].bodies[0] == "red_2" and "red_2_FL_calf" in found["red_2"].bodies


@pytest.mark.parametrize(
    ("assets", "told"),
    [
        (rows(goal=5), "a goal each"),
        (rows().replace("ball: ball", "ball: post"), "no single thing that is free to move"),
        (rows(ball="bell"), "bell"),
        (ROW.format(name="red", look="#d02020", ball="ball", goal=5), "here are 1 rows"),
        (rows().replace("goal: [-5, 0]}", "goal: [-5, 0]}, y_m: 0"), "keeps to no line"),
    ],
)
def test_half_a_match_and_a_ball_that_is_none_are_told(write, assets, told):
    assert any(told in f.message for f in check_plan(write(assets)).findings if f.severity == "error")
