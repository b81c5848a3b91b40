"""The proof run of a long physics is made beside what comes before acceptance, which finds it; what is changed meanwhile ends it."""

import os
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright import proof_beside
from worldwright.model.evidence.run import Run
from worldwright.stamp import audited, private, proof_ahead
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State


@pytest.fixture
def measured(reviewed: Path, copy: Callable[[Path], Path], monkeypatch: pytest.MonkeyPatch) -> Run:
    monkeypatch.delenv(proof_ahead.SWITCH)
    monkeypatch.setattr(os, "nice", lambda _: 0)  # the tests' own process keeps its priority
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
    assert "`accept` finds it" in proof_ahead.begin(measured)
    assert begun[0][3:5] == [proof_ahead.MODULE, str(measured.folder)]
    assert "scan scan" in audited.robust_beside(measured) and len(begun) == 1


@pytest.mark.slow
def test_acceptance_finds_it(measured: Run) -> None:
    proof_beside.main(str(measured.folder))
    answer = stamp.accept(str(measured.folder), timeout_s=60)
    assert answer.ok and answer.proof_earlier


def test_what_is_changed_meanwhile_ends_it(measured: Run, monkeypatch: pytest.MonkeyPatch) -> None:
    before = State(measured)
    assert before.key is not None

    def proved(*_: object, **__: object) -> None:
        measured.plan.write_text(measured.plan.read_text().replace("\n", "\n\n", 1))

    monkeypatch.setattr(proof_ahead, "prove", proved)
    assert proof_ahead.finish(measured) is False
    assert not (private.proofs(measured, before.key.key) / "again").exists()
