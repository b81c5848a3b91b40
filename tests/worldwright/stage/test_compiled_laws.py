"""A law of matter is compiled before the job that needs it begins: its limits do not count that, and it says what it does."""

import sys
from pathlib import Path

import pytest

from worldkit import kept_kernels
from worldwright.model.evidence import environment
from worldwright.stage import compiled_laws, launch
from worldwright.stage.job import Job, JobStatus
from worldwright.stage.supervisor import Supervision


@pytest.fixture
def bare(monkeypatch, tmp_path) -> Path:
    """Where nothing is compiled; compiling leaves a file there."""
    made = tmp_path / "made"
    monkeypatch.setattr(kept_kernels, "MARK", tmp_path / "no mark")
    monkeypatch.setattr(kept_kernels, "CALL", (sys.executable, "-c", f"open({str(made)!r}, 'w')"))
    return made


@pytest.mark.parametrize(
    "line",
    [
        "from worldkit.matter import Snow",
        "from worldkit import matter",
        "import worldkit.matter",
        "from worldkit import (\n    scene,\n    matter,\n)",
    ],
)
def test_only_a_program_that_uses_matter_waits_and_only_where_it_is_not_compiled(bare, tmp_path, monkeypatch, line):
    inputs = tmp_path / "inputs"
    (inputs / "laws").mkdir(parents=True)
    (inputs / "simulation.py").write_text("from worldkit import program\n# the matter of worldkit is not used\n")
    (inputs / "data.py").mkdir()
    assert not compiled_laws.lacking(inputs)
    (inputs / "laws" / "snow.py").write_text(f"{line}\n")
    assert compiled_laws.lacking(inputs)
    monkeypatch.setattr(kept_kernels, "may_be_kept", lambda: False)
    assert not compiled_laws.lacking(inputs)
    monkeypatch.undo()
    monkeypatch.setattr(kept_kernels, "compiled", lambda: True)
    assert not compiled_laws.lacking(inputs)


def test_the_job_tells_that_it_compiles_before_its_time_begins(bare, make, monkeypatch):
    run = make("from worldkit.matter import Snow\n")
    monkeypatch.setattr(launch, "_detach", lambda _: None)
    launch.launch(run, run.evidence_key(environment.current().sha256()), "physics")
    supervision = Supervision(Job.find(run, None))
    supervision.compile_ahead()
    told = JobStatus.model_validate_json((supervision.job.folder / "state.json").read_text())
    assert bare.exists() and (told.state, told.code) == ("running", "compiling")
    assert "numba compiles worldkit.matter, once" in told.text()


def test_a_cancelled_job_does_not_wait_for_the_compiler(monkeypatch):
    monkeypatch.setattr(kept_kernels, "CALL", (sys.executable, "-c", "import time; time.sleep(60)"))
    compiled_laws.compile_ahead(lambda: True)
