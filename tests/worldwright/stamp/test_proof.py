"""A proof makes everything of a world anew, and tells how it ended."""

import uuid
from pathlib import Path
from types import SimpleNamespace

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import GateError, JobError
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run
from worldwright.stage import limits
from worldwright.stage import tools as stage
from worldwright.stage.job import JobStatus
from worldwright.stamp import proof, rebuilt
from worldwright.stamp import tools as stamp

BOWL = """\
import numpy as np
from worldkit import sculpt

BOWL = (sculpt.sphere(0.2).shell(0.02) - sculpt.half_space((0, 0, -1), 0.0)) - sculpt.half_space((0, 0, 1), -0.09)


def paint(points, normals):
    return DRAWS.random(points.shape)


POT = sculpt.Part("pot", BOWL, paint=paint, make={"cells": 24, "texels": 64})
"""


@pytest.fixture
def built(tmp_path: Path, sculpted_plan: str):
    """Builds a run's world whose bowl is painted by draws; returns what `proof.prove` takes, its world laid out as kept."""
    from worldwright.draft.writing import write_program

    def build(draws: str) -> dict:
        run = Run(tmp_path / "bowl")
        (run.folder / "sculpt").mkdir(parents=True)
        run.plan.write_text(sculpted_plan)
        (run.folder / "sculpt/bowl.py").write_text(BOWL.replace("DRAWS", draws) + f"# {uuid.uuid4()}\n")
        stamp.approve(str(run.folder), by="tester")
        write_program(run)
        job = stage.start(str(run.folder), stage="bundle")
        while not job.ended:
            job = stage.wait(str(run.folder), job=job.job)
        assert job.state == "succeeded", job.text()
        kept = proof.lay_out(tmp_path / "kept", Path(job.result) / proof.WORLD, Path(job.result))
        told = {"program": run.program.read_bytes(), "plan": run.plan.read_bytes(), "near": proof.beside(run.folder)}
        return {**told, "folder": tmp_path / "proof", "reason": "a test", "timeout_s": 300, "kept": kept}

    return build


def test_a_paint_that_draws_unseeded_is_refused_though_its_shape_is_kept(built) -> None:
    """The run itself always takes the kept shape; a proof makes it anew, as another machine would."""
    with pytest.raises(GateError, match=r"another world .* seen in its model.xml, line \d+: `<texture") as caught:
        proof.prove(**built("np.random.default_rng()"))
    assert "seed every random draw" in caught.value.next_move


def test_a_paint_that_draws_from_a_global_generator_is_proved(built) -> None:
    """Its draws depend on what is made alone, whether earlier shapes were kept or not."""
    proved = proof.prove(**built("np.random"))
    assert proved is not None and proved.rebuilt == rebuilt.SAME


def ended(state: str, code: str) -> JobStatus:
    told = {"message": "it ended", "place": "simulation.py:7", "next_move": "do this"}
    return JobStatus(job="bundle-1", stage="bundle", key="", state=state, code=code, **told)


ENDED = [
    ("failed", "disk_full", JobError),
    ("failed", "out_of_memory", JobError),
    ("failed", "killed", JobError),
    ("cancelled", "cancelled", JobError),
    ("failed", "unnamed_asset", GateError),
    ("failed", "crashed", GateError),
]


@pytest.mark.parametrize(("state", "code", "raised"), ENDED)
def test_a_build_that_ends_badly_is_told_as_it_ended(
    state: str, code: str, raised: type, tmp_path: Path, small_plan: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A full disk says nothing about a world: nothing is refuted, and the job's log stays."""
    monkeypatch.setattr(stage, "start_fresh", lambda *_: ended(state, code))
    monkeypatch.setattr(lint, "check_program", lambda *_, **__: LintReport())
    with pytest.raises(raised, match="it ended") as caught:
        proof.prove(tmp_path / "proof", b"", small_plan.encode(), reason="a test", timeout_s=1, kept=tmp_path)
    assert code in (caught.value.code, caught.value.cause.split(": ")[1])
    assert (caught.value.place, caught.value.next_move) == ("simulation.py:7", "do this")
    assert (tmp_path / "proof/plan.md").is_file()


@pytest.mark.parametrize(
    ("status", "raised", "said"),
    [(-9, JobError, "SIGKILL"), (-11, GateError, "WM101"), (134, GateError, "WM101"), (1, GateError, "WM101")],
    ids=["killed", "segfault", "abort", "exit"],
)
def test_the_machine_is_judged_before_lint_and_a_program_by_lint(
    status: int, raised: type, said: str, tmp_path: Path, small_plan: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Where there is no room to build a world, lint finds none either; that is not the program's fault."""
    found = SimpleNamespace(severity="error", code="WM101", message="no world", line=None, fix="")
    told = limits.failed(status, {}, {}, "its log")
    job = ended("failed", "").model_copy(update=told)
    monkeypatch.setattr(stage, "start_fresh", lambda *_: job)
    monkeypatch.setattr(lint, "check_program", lambda *_, **__: SimpleNamespace(findings=(found,), rules=()))
    with pytest.raises(raised, match=said):
        proof.prove(tmp_path / "proof", b"", small_plan.encode(), reason="a test", timeout_s=1, kept=tmp_path)
