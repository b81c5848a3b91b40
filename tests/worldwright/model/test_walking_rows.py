"""A robot that walks is one row of a plan: declared, drafted whole, and approved with its policy."""

from pathlib import Path

import pytest
from pydantic import ValidationError

import packaged_dogs
from worldkit.robots import packaged
from worldwright.draft import draft
from worldwright.lint.tools import check_plan
from worldwright.model.errors import PlanError
from worldwright.model.plan.imported import contents, load
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.plan.scene_objects import AssetRow
from worldwright.place.engine import resolve
from worldwright.stamp.gates.auto_approve import _chosen

TEXT = (Path(__file__).parents[1] / "world/walking_robot_plan.md").read_text(encoding="utf-8")


@pytest.fixture
def written(tmp_path, monkeypatch):
    """The plan of the walking dog with a small dog and a small policy in its place."""
    key = packaged_dogs.install(tmp_path / "site", monkeypatch).key
    packaged.lay(key, tmp_path / "run" / key)
    packaged_dogs.walk(tmp_path / "run" / key / "walk.onnx")
    path = tmp_path / "run/plan.md"
    path.write_text(TEXT.replace("go2", key), encoding="utf-8")
    return path


def test_a_row_declares_and_drafts_all_of_it(written):
    assert not [f for f in check_plan(written).findings if f.severity == "error"]
    plan = read_plan(written).plan
    row = plan.assets[0]
    servos = tuple(row.walks.driven("go1"))
    assert [a.name for a in plan.topology.actuators] == list(servos)
    (control,) = plan.simulation_parameters.interventions
    assert control.bodies == servos and control.kind == "control" and "35.55 N·m" in control.law
    made = draft(plan, resolve(plan).scene)
    assert not made.open_places
    assert 'GO1_WALKERS = robots.walkers(("go1",), "go1", "go1/walk.onnx")' in made.source
    assert "robots.along(data, name, speed=0.8 if data.time < 7.0 else 0.0)" in made.source
    assert {"go1/walk.onnx", "go1/go1.xml", "go1/assets/shin.obj"} == set(contents(plan))


def test_robots_of_a_row_share_a_line_where_it_names_one(written):
    text = written.read_text(encoding="utf-8")
    for said, drafted in ((", y_m: 0}", True), ("}", False)):
        written.write_text(text.replace("until_s: 7.0}", f"until_s: 7.0{said}"), encoding="utf-8")
        plan = read_plan(written).plan
        assert ("y=0.0" in draft(plan, resolve(plan).scene).source) == drafted


def test_where_it_walks_needs_a_mark_that_leads_there(written):
    names = [f"assets.go1.walks.{name}" for name in ("speed_m_s", "until_s", "y_m", "heading_deg")]
    text = written.read_text(encoding="utf-8")
    assert [name for name, _ in _chosen(read_plan(written).plan) if ".walks." in name] == names[:2]
    text = text.replace("until_s: 7.0}", "until_s: 7.0, y_m: 0.5, heading_deg: -10}")
    written.write_text(text.replace("time_step:", f"inferred: [{', '.join(names)}]\ntime_step:", 1), encoding="utf-8")
    plan = read_plan(written).plan
    assert [pair for pair in _chosen(plan) if ".walks." in pair[0]] == list(
        zip(names, ([0.8], [7.0], [0.5], [10.0]), strict=True)
    )
    assert set(names) <= set(plan.simulation_parameters.inferred)
    assert not [f for f in check_plan(written).findings if f.code == "WP124"]


def test_a_policy_that_is_none_or_another_is_told_where_the_plan_names_it(written):
    row, folder = read_plan(written).plan.assets[0], written.parent
    other = row.model_copy(update={"walks": row.walks.model_copy(update={"sha256": "0" * 64})})
    with pytest.raises(PlanError, match="SHA-256"):
        load(other, folder)
    packaged_dogs.policy(folder / "go1/walk.onnx", 48, 12, operator="Balance", domain="ai.maker")
    with pytest.raises(PlanError, match=r"ai\.maker\.Balance"):
        load(row, folder)
    (folder / "go1/walk.onnx").unlink()
    assert any("no policy go1/walk.onnx" in f.message for f in check_plan(written).findings)


@pytest.mark.parametrize(
    ("changed", "told"),
    [
        ({"walks": {"gait": "trot"}}, "there is no gait `trot`"),
        ({"walks": {"policy": "../walk.onnx"}}, "lies elsewhere"),
        ({"walks": {"until_s": float("inf")}}, "finite number"),
        ({"fixed": True}, "free to move"),
    ],
)
def test_a_row_that_cannot_walk_says_why(changed, told):
    walks = {"policy": "walk.onnx", "gait": "go1", "speed_m_s": 0.5, **changed.pop("walks", {})}
    with pytest.raises(ValidationError, match=told):
        AssetRow.model_validate({"name": "dog", "type": "mjcf", "filename": "dog.xml", "walks": walks, **changed})
