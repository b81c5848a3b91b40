"""The proof run of a long physics is made beside what comes before acceptance, which finds it; what is changed meanwhile ends it."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright import proof_beside
from worldwright.model import work_beside
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence.run import Run
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stage.job import JobStatus
from worldwright.stamp import audited, private, proof_ahead, proof_told
from worldwright.stamp import tools as stamp
from worldwright.stamp.accepted import Accepted
from worldwright.stamp.state import State


@pytest.fixture
def measured(reviewed: Path, copy: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.delenv(work_beside.SWITCH)
    monkeypatch.setattr(os, "nice", lambda more: None if more == proof_ahead.BEHIND else pytest.fail(f"{more} nicer"))
    return Run(copy(reviewed))


def test_a_short_physics_is_proved_while_acceptance_is_waited_for(measured: Run) -> None:
    assert proof_ahead.begin(measured) == ""


def test_of_a_long_one_a_process_makes_it_and_the_worlds_a_little_otherwise_wait(
    measured: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[list[str]] = []
    monkeypatch.setattr(subprocess, "Popen", lambda words, **_: begun.append(words))
    monkeypatch.setattr(proof_ahead, "LONG_S", 0.0)
    monkeypatch.setattr(audited, "LONG_S", 0.0)
    assert "`go` and `accept` find it" in proof_ahead.begin(measured)
    assert begun[0][3:5] == [proof_ahead.MODULE, str(measured.folder)]
    assert "scan scan" in audited.robust_beside(measured) and len(begun) == 1


def test_while_a_proof_is_made_ahead_the_worlds_a_little_otherwise_wait_for_its_end(
    measured: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    begun: list[Run] = []
    monkeypatch.setattr(subprocess, "Popen", lambda words, **_: begun.append(words))
    assert "once the proof run has ended" in audited.robust_beside(measured, proving=True) and not begun
    monkeypatch.setattr(audited, "robust_beside", begun.append)
    for whole in (False, True):
        monkeypatch.setattr(proof_ahead, "finish", lambda _, whole=whole: whole)
        proof_beside.main(str(measured.folder))
    assert [run.folder for run in begun] == [measured.folder]


def test_the_repetitions_that_causes_ask_for_come_first_also_of_a_short_physics(
    measured: Run, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[str] = []

    def scanned(folder: str, **_: object) -> SimpleNamespace:
        asked.append(folder)
        return SimpleNamespace(pending=("without the push",) * (len(asked) < 3))

    monkeypatch.setattr(audited, "why_causes", lambda _: "objective 0 names its cause")
    monkeypatch.setattr(audited, "standing", lambda *_: "absent")
    monkeypatch.setattr(subprocess, "Popen", lambda *_, **__: None)
    assert "repetitions" in proof_ahead.begin(measured) and "proof run" not in proof_ahead.begin(measured)
    monkeypatch.setattr(scan, "scan", scanned)
    assert proof_ahead.finish(measured) is True and asked == [str(measured.folder)] * 3


@pytest.mark.slow
def test_acceptance_finds_it(measured: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(audited, "robust_beside", lambda _: "")  # nothing goes on after the test
    monkeypatch.setattr(proof_ahead, "LONG_S", 0.0)
    proof_beside.main(str(measured.folder))
    assert proof_ahead.begin(measured) == ""
    answer = stamp.accept(str(measured.folder), timeout_s=60)
    assert answer.ok and answer.proof_earlier
    assert proof_ahead.begin(measured) == "", "what is accepted is proved"


def test_whoever_waits_for_it_is_told_how_far_it_is_and_what_is_beside_it(
    measured: Run, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    job = JobStatus(
        job="physics-1", stage="physics", key="k", state="running", done=4, total=20, unit="s", wall_s=3, eta_s=12
    )
    film = job.model_copy(update={"job": "video-2", "stage": "video"})
    stages = {str(tmp_path / "proof"): [job], str(measured.folder): [film]}

    def status(folder: str) -> SimpleNamespace:
        if folder not in stages:
            raise NotFoundError("no job", next_move="begin one")
        return SimpleNamespace(jobs=stages[folder], audits=[])

    monkeypatch.setattr(stage, "status", status)
    told = proof_told.line(State(measured), tmp_path, "proof")
    assert "4/20 s, about 12 s left" in told and "then the world, driven again" in told
    assert "beside it, on the same processor: video running" in told
    assert "it begins" in proof_told.line(State(measured), tmp_path, "again")
    answer = Accepted(state="proving", run="ball", under_way=told, next_move="worldwright stamp accept ball")
    assert answer.text().startswith(f"ball: the proof run goes on: {told}\n  next: ")


def test_what_is_changed_meanwhile_ends_it(measured: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    before = State(measured)
    assert before.key is not None

    def proved(*_: object, **__: object) -> None:
        measured.plan.write_text(measured.plan.read_text().replace("\n", "\n\n", 1))

    monkeypatch.setattr(proof_ahead, "LONG_S", 0.0)
    monkeypatch.setattr(proof_ahead, "prove", proved)
    assert proof_ahead.finish(measured) is False
    assert not (private.proofs(measured, before.key.key) / "again").exists()
