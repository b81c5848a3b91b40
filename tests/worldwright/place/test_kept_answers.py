"""The pre-roll is asked once a question, and again when anything changed that its answer depends on."""

import os
import shutil
import subprocess
from pathlib import Path

import pytest

from worldkit import assets
from worldwright.model.errors import JobError
from worldwright.model.plan.committed import Plan
from worldwright.place import kept_answers
from worldwright.place.asking import simulate
from worldwright.place.engine import resolve

pytestmark = pytest.mark.usefixtures("started_preroll")


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
    monkeypatch.delenv("WORLDWRIGHT_PREROLLS", raising=False)
    real, calls = subprocess.Popen, []
    monkeypatch.setattr(subprocess, "Popen", lambda *words, **more: calls.append(words) or real(*words, **more))

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


def question(**changes: object) -> dict:
    """What the place of an answer is found by."""
    return {"objects": [{"asset": "apple", "model": None}], "gravity": [0, 0, -9.81], **changes}


def test_a_test_run_takes_no_answer_from_the_cache_of_who_runs_it():
    assert kept_answers.place_of(question()).parent == Path(os.environ["WORLDWRIGHT_DATA"]) / "prerolls"


def test_a_changed_asset_is_asked_about_anew(asked, monkeypatch, tmp_path):
    there = tmp_path / "catalog"
    for name in ("apple", "mug"):
        shutil.copytree(assets.catalog_root() / name, there / name)
    monkeypatch.setenv("WORLDWRIGHT_CATALOG", str(there))
    before = kept_answers.place_of(question())
    for name in ("mug", "apple"):
        entry = there / name / "asset.yaml"
        entry.write_text(f"{entry.read_text()}\n# edited\n")
        assert (kept_answers.place_of(question()) == before) == (name == "mug")


def test_another_environment_or_other_code_is_asked_anew(asked, monkeypatch):
    before = kept_answers.place_of(question())
    assert kept_answers.place_of(question()) == before and before.parent == asked.kept
    now = kept_answers.environment.current()
    with monkeypatch.context() as patch:
        patch.setattr(
            kept_answers.environment, "current", lambda: now.model_copy(update={"simulator_sha256": "0" * 64})
        )
        assert kept_answers.place_of(question()) != before
    with monkeypatch.context() as patch:
        patch.setattr(kept_answers, "below", lambda *_: ())
        assert kept_answers.place_of(question()) != before
    with monkeypatch.context() as patch:
        patch.setattr(kept_answers, "version", lambda _: "0")
        assert kept_answers.place_of(question()) != before


def test_an_answer_about_a_model_file_is_not_kept(asked):
    assert kept_answers.place_of(question(objects=[{"asset": None, "model": {"text": "<mujoco/>"}}])) is None


def test_what_cannot_be_read_is_asked_anew_and_a_cache_that_cannot_be_written_costs_nothing(asked, monkeypatch):
    asked(plan())
    (kept,) = asked.kept.glob("*.json")
    for broken in (b"[]", b"{}", b"[" * 100_000):
        kept.write_bytes(broken)
        assert kept_answers.read(kept) is None
    assert asked(plan())[1] == 1
    monkeypatch.setenv("WORLDWRIGHT_CACHE", "/proc/nowhere")
    assert asked(plan())[1] == 1


def test_a_failure_is_not_kept(asked, monkeypatch):
    with pytest.raises(JobError, match="pre-roll"):
        asked(plan(), duration_s=float("nan"))
    assert not list(asked.kept.glob("*.json"))


WHOLE = b'{"contacts": [], "objects": {}, "distances": [], "drops": [], "views": []}'


def name(digit: str) -> str:
    """What an answer is called."""
    return f"{digit * 64}.json"


def given(folder, *names: str) -> None:
    """Answers that were kept long ago, a minute after each other."""
    folder.mkdir(exist_ok=True)
    for number, name in enumerate(names):
        (folder / name).write_bytes(WHOLE)
        os.utime(folder / name, ns=(0, (number + 1) * 60 * 10**9))


@pytest.mark.parametrize("bound", [("MOST", 2), ("MOST_BYTES", 2 * len(WHOLE))], ids=["number", "bytes"])
def test_those_given_longest_ago_go_first(asked, monkeypatch, bound):
    monkeypatch.setattr(kept_answers, *bound)
    given(asked.kept, "my own.json", "abc", name("0"), name("1"), name("2"))
    assert kept_answers.read(asked.kept / name("0")) is not None  # read is given
    kept_answers.keep(asked.kept / name("3"), WHOLE)
    left = {path.name for path in asked.kept.iterdir()}
    assert left == {name("0"), name("3"), "my own.json", "abc"}, "what is not ours is never removed"


def test_what_was_left_half_written_goes(asked):
    given(asked.kept, f".{name('0')}.abandoned", ".gitignore")
    (asked.kept / f".{name('1')}.under-way").write_bytes(b"{")
    kept_answers.keep(asked.kept / name("2"), WHOLE)
    left = {path.name for path in asked.kept.iterdir()}
    assert left == {f".{name('1')}.under-way", name("2"), ".gitignore"}, "what is not ours is never removed"


def test_a_cache_that_is_only_read_answers(asked, monkeypatch):
    given(asked.kept, "0.json")

    def refused(*_):
        raise PermissionError(13, "read-only")

    monkeypatch.setattr(kept_answers.os, "utime", refused)
    assert kept_answers.read(asked.kept / "0.json") is not None
