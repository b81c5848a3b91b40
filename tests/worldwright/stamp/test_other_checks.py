"""A finding counts only as long as the code of the checks is the one that made it: after an update it is made anew."""

import json
import time
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run
from worldwright.stamp import steps
from worldwright.stamp.going import Going
from worldwright.stamp.state import State

Copy = Callable[[Path], Path]
NAMES = ("scan", "expect")


@pytest.mark.parametrize("name", NAMES)
def test_what_other_code_of_the_checks_found_is_found_anew(
    reviewed: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    run = Run(copy(reviewed))
    path = State(run).folder / f"{name}.json"
    said = json.loads(path.read_text(encoding="utf-8"))
    assert said["code_sha256"] == environment.checks() != ""
    assert steps.one(State(run), name).holds
    monkeypatch.setattr(environment, "checks", lambda: "after an update")
    step = steps.one(State(run), name)
    assert step.status == "missing" and "another version of the checks" in step.detail
    assert step.next_move.startswith(f"worldwright scan {name}")
    getattr(Going(run), name)()
    assert steps.one(State(run), name).holds
    assert json.loads(path.read_text(encoding="utf-8")) == {**said, "code_sha256": "after an update"}


@pytest.mark.parametrize("name", NAMES)
def test_a_report_of_before_there_was_such_a_hash_counts_as_other(reviewed: Path, copy: Copy, name: str) -> None:
    run = Run(copy(reviewed))
    path = State(run).folder / f"{name}.json"
    said = json.loads(path.read_text(encoding="utf-8"))
    del said["code_sha256"]
    path.write_text(json.dumps(said), encoding="utf-8")
    assert steps.one(State(run), name).status == "missing"


def test_the_hash_follows_the_code_and_is_asked_once_a_process(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    check = tmp_path / "worldwright" / "scan" / "check.py"
    check.parent.mkdir(parents=True)
    monkeypatch.setattr(environment, "SERVERS", tmp_path)
    monkeypatch.setenv("WORLDWRIGHT_CACHE", str(tmp_path / "cache"))
    found = []
    for text in ("LIMIT = 1\n", "LIMIT = 2.5\n"):
        check.write_text(text, encoding="utf-8")
        found.append(environment.checks.__wrapped__())
    assert found[0] != found[1]
    began = time.perf_counter()
    assert environment.checks() == environment.checks()
    environment.checks()
    assert time.perf_counter() - began < 1.0
