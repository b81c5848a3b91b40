"""The pre-roll is asked once a question, and again when anything changed that its answer depends on."""

import subprocess

import pytest

from worldwright.model.errors import JobError
from worldwright.model.plan.committed import Plan
from worldwright.place import kept_answers
from worldwright.place.asking import simulate
from worldwright.place.engine import resolve


def plan(mass: float = 0.2) -> Plan:
    """A ball above an apple of the catalog."""
    return Plan.model_validate(
        {
            "plan_type": "mbs",
            "simulation_parameters": {"time_step": 0.002, "simulation_duration": 1.0, "masses": {"ball": mass}},
            "objectives": [{"claim": "it falls"}],
            "scene_objects": [{"name": "ball", "primitive": "sphere", "size": [0.1, 0.1, 0.1]}],
            "assets": [{"name": "apple", "filename": "apple"}],
            "asset_dimensions": {"apple": 0.08},
            "topology": {"body_positions": {"ball": {"x": 0, "y": 0, "z": 0.4}, "apple": {"x": 1, "y": 0, "z": 0.04}}},
            "implementation_steps": [{"description": "let go", "motion_expectations": ["ball"]}],
        }
    )


@pytest.fixture
def asked(monkeypatch, tmp_path):
    """An empty cache; returns a function that asks and tells how many processes that took."""
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path))
    real, calls = subprocess.run, []
    monkeypatch.setattr(subprocess, "run", lambda *words, **more: calls.append(words) or real(*words, **more))

    def ask(plan: Plan, **more: object) -> tuple[dict, int]:
        calls.clear()
        return simulate(plan, resolve(plan).scene, **more), len(calls)

    ask.kept = tmp_path / "prerolls"
    return ask


def test_the_same_question_is_answered_from_what_was_kept(asked):
    first, took = asked(plan(), duration_s=0.1)
    again, took_again = asked(plan(), duration_s=0.1)
    assert (took, took_again) == (1, 0)
    assert again == first and first["objects"]["ball"]["end"][2] < 0.4
    assert asked(plan(), duration_s=0.2)[1] == 1  # another question
    assert asked(plan(mass=0.3), duration_s=0.1)[1] == 1


def test_a_changed_asset_is_asked_about_anew(asked, monkeypatch):
    asked(plan())
    changed = kept_answers.sha256_of
    monkeypatch.setattr(
        kept_answers, "sha256_of", lambda name, files: "other" if name == "placed-apple" else changed(name, files)
    )
    assert asked(plan())[1] == 1


def test_what_cannot_be_read_is_asked_anew_and_a_cache_that_cannot_be_written_costs_nothing(asked, monkeypatch):
    asked(plan())
    (kept,) = asked.kept.glob("*.json")
    kept.write_bytes(b"[]")
    assert asked(plan())[1] == 1
    monkeypatch.setenv("WORLDWRIGHT_CACHE", "/proc/nowhere")
    assert asked(plan())[1] == 1


def test_a_failure_is_not_kept(asked, monkeypatch):
    with pytest.raises(JobError, match="pre-roll"):
        asked(plan(), duration_s=float("nan"))
    assert not list(asked.kept.glob("*.json"))


def test_the_oldest_go_first(asked, monkeypatch):
    monkeypatch.setattr(kept_answers, "MOST", 2)
    for number in range(3):
        kept_answers.keep(asked.kept / f"{number}.json", b"{}")
    assert len(list(asked.kept.glob("*.json"))) == 2
