"""The copies of an object stand once in a draft, and the lists that name them read as if all were written out."""

import pytest

from worldkit import program
from worldwright.draft import draft
from worldwright.draft.crowds import CROWD, Crowds
from worldwright.lint import engine
from worldwright.lint import source as sources
from worldwright.model.plan.committed import Plan
from worldwright.place.engine import resolve


def plan(count: int, **parameters: object) -> Plan:
    row = {"name": "post", "primitive": "box", "size": [0.1, 0.1, 0.3], "fixed": True}
    ball = {"name": "ball", "primitive": "sphere", "size": [0.04, 0.04, 0.04], "count": count}
    at = {"pattern": "row", "step": [0.06, 0, 0]}
    cameras = [{"name": "side", "view": "side_minus_y", "subjects": ["post", "ball"]}, "perspective"]
    return Plan.model_validate({
        "title": "Balls in a row",
        "plan_type": "mbs",
        "simulation_parameters": {
            "time_step": 0.002, "simulation_duration": 1.0, "masses": {"ball": 0.1}, **parameters,
        },
        "objectives": [{"claim": "they roll"}],
        "scene_objects": [row, ball],
        "topology": {"scene_predicates": [
            {"subject": "post", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 1}},
            {"subject": "ball", "predicate": "PLACE-ON-BASE", "params": {"x": 0, "y": 0}, "spread": at},
        ]},
        "implementation_steps": [{"description": "roll", "cameras": cameras, "motion_expectations": ["ball"]}],
    })  # fmt: skip


def test_a_crowd_is_written_once_and_means_all_of_it(monkeypatch):
    made, handed = plan(CROWD), {}
    source = draft(made, resolve(made).scene).source
    assert source.count("ball_3") == 1, "where its place is"
    monkeypatch.setattr(program, "main", lambda build, **given: handed.update(given, model=build().compile()))
    exec(source, {"__name__": "__main__"})
    assert handed["movers"] == made.families["ball"]
    few = plan(CROWD - 1)
    assert draft(few, resolve(few).scene).source.count('"ball_3"') == 4, "a few are read more easily as they are"


def test_names_are_read_back_as_they_were_listed():
    crowds = Crowds(made := plan(CROWD))
    balls = made.families["ball"]
    for names in (("post", *balls), (*balls, "post"), balls[1:], (*balls, *balls), ("post",), ()):
        told = crowds.listed(names)
        assert eval(told, {"BALL_NAMES": balls}) == names
    assert crowds.written() == f'BALL_NAMES = tuple(f"ball_{{n}}" for n in range(1, {CROWD + 1}))\n'


@pytest.mark.parametrize("taken", ["constants", "materials"])
def test_a_name_that_the_plan_gives_away_is_not_taken_again(taken):
    value = {
        "constants": {"value": 3.0, "unit": "1", "source": "the sentence"},
        "materials": {"friction": 0.3, "source": "handbook"},
    }[taken]
    crowds = Crowds(made := plan(CROWD, **{taken: {"ball_names": value}}))
    assert "BALL_NAMES" not in crowds.listed(made.families["ball"]) and crowds.written() == ""


def test_lint_has_nothing_to_say_against_a_draft_with_a_crowd():
    source = draft(made := plan(CROWD), resolve(made).scene).source
    assert "BALL_NAMES" in source and engine.check_source(sources.parse(source), made) == []
