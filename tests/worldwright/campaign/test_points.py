"""The points of a sweep: each a function of its number, within what was asked for, and the same tomorrow."""

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from worldwright.campaign import points, setting_out
from worldwright.campaign.campaign_file import Axis, CampaignError, Sweep, parse
from worldwright.campaign.plan_fields import numbers, path_of
from worldwright.model.plan.plan_text import parse_plan


def sweep(**fields):
    draws = fields.pop("draws", 1)
    return Sweep(fields={name: Axis.model_validate(axis) for name, axis in fields.items()}, draws=draws)


def test_the_grid_is_the_product_and_its_last_field_turns_fastest():
    grid = sweep(
        a={"values": [1, 2]}, b={"from": 0, "to": 1, "steps": 3}, c={"from": 1, "to": 100, "steps": 3, "spacing": "log"}
    )
    found = [tuple(points.at(grid, n).values()) for n in range(grid.size)]
    assert found[:4] == [(1, 0, 1), (1, 0, 10), (1, 0, 100), (1, 0.5, 1)]
    assert len(set(found)) == 18 and found[-1] == (2, 1, 100)


def test_a_longer_sweep_keeps_the_worlds_of_a_shorter_one():
    drawn = {"a": {"values": [1, 2]}, "x": {"uniform": [0, 1]}, "n": {"integers": [1, 6]}}
    short, long = sweep(**drawn, draws=3), sweep(**drawn, draws=8)
    assert [points.at(short, n) for n in range(3)] == [points.at(long, n) for n in range(3)]
    assert points.at(short, 0)["x"] != points.at(short, 1)["x"]
    other = short.model_copy(update={"seed": 1})
    assert points.at(short, 0)["x"] != points.at(other, 0)["x"]


@given(st.integers(0, 99))
def test_what_is_drawn_lies_where_it_may(number):
    drawn = sweep(
        u={"uniform": [-2, 3]}, g={"log_uniform": [0.01, 100]}, n={"normal": [5, 2], "within": [4, 5]}, i={"integers": [1, 3]},
        draws=100,
    )  # fmt: skip
    found = points.at(drawn, number)
    assert -2 <= found["u"] <= 3 and 0.01 <= found["g"] <= 100 and 4 <= found["n"] <= 5 and found["i"] in (1, 2, 3)


def test_a_million_points_are_counted_without_being_made():
    campaign = parse("plan: a\nsweep: {fields: {x: {from: 0, to: 1, steps: 1000}, y: {from: 0, to: 1, steps: 1000}}}")
    assert campaign.size == 1_000_000
    assert points.at(campaign.sweep, 999_999) == {"x": 1.0, "y": 1.0}


def test_steps_that_are_equal_once_they_are_written_are_found():
    close = {"from": 1, "to": 1.00000000001, "steps": 12}
    near = {
        "none": {"from": 0, "to": 5e-324, "steps": 3},
        "log": {**close, "spacing": "log"},
        "linear": close,
        "falling": {**close, "from": close["to"], "to": 1},
    }
    for axis in sweep(**near).fields.values():
        first, second = points.equal_neighbours(axis)
        assert points.along(axis, first) == points.along(axis, second)
    fine = sweep(
        a={"from": 1, "to": 1.00000000001, "steps": 2}, b={"from": -1, "to": 1, "steps": 1_000_000}, c={"values": [1, 2]},
        d={"from": 0, "to": 1e-300, "steps": 9}, e={"uniform": [0, 1]}, f={"from": 0, "to": 0, "steps": 1},
        g={"from": 1, "to": 1e9, "steps": 1_000_000, "spacing": "log"},
    )  # fmt: skip
    assert not any(map(points.equal_neighbours, fine.fields.values()))


def test_one_number_is_swept_once_and_by_steps_that_differ(small_plan, tmp_path):
    (tmp_path / "plan.md").write_text(small_plan, encoding="utf-8")
    file, ball = tmp_path / "c.yaml", "simulation_parameters.masses.ball"
    for fields, cause in (
        (
            {"scene_objects.ball.size[0]": {"values": [1]}, "scene_objects[0].size[0]": {"values": [2]}},
            "are one number",
        ),
        ({ball: {"from": 1, "to": 1.00000000001, "steps": 12}}, "12 steps from 1 to 1.0000000000"),
    ):
        file.write_text(json.dumps({"plan": "plan.md", "sweep": {"fields": fields}}))
        with pytest.raises(CampaignError, match=cause) as refused:
            setting_out.checked(file)
        assert all(name in refused.value.cause for name in fields) and refused.value.next_move


def test_a_number_of_a_plan_is_found_by_its_path(small_plan):
    document = parse_plan(small_plan)
    assert path_of(document, "simulation_parameters.masses.ball") == ("simulation_parameters", "masses", "ball")
    assert path_of(document, "scene_objects.ball.size[2]") == ("scene_objects", 0, "size", 2)
    assert path_of(document, "topology.scene_predicates[0].params.bottom")[1:3] == ("scene_predicates", 0)
    assert numbers(document)["simulation_parameters.masses.ball"] == 0.2


@pytest.mark.parametrize(
    "field",
    ["", "x", "simulation_parameters.mass.ball", "scene_objects[4].size[0]", "scene_objects.ball.name", "simulation_parameters",
     "scene_objects.ball.size[2]x", "scene_objects..ball", "plan_type", "scene_objects.ball.size[-1]", f"scene_objects[{'9' * 5000}].size[0]"],
)  # fmt: skip
def test_what_is_no_number_of_the_plan_is_answered_with_those_that_are(small_plan, field):
    with pytest.raises(CampaignError) as refused:
        path_of(parse_plan(small_plan), field)
    assert "simulation_parameters" in refused.value.next_move or "scene_objects" in refused.value.next_move
