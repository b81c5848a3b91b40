"""A run in another environment than it was locked to is refused with the differences."""

import json

import pytest
from click.testing import CliRunner

from worldwright.cli import main
from worldwright.model.errors import GateError
from worldwright.stage.job import Job
from worldwright.stage.tools import start

GOOD = """
import mujoco
from worldkit import program

def build():
    spec = mujoco.MjSpec()
    ball = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    ball.add_freejoint()
    ball.add_geom(size=(0.1, 0, 0))
    return spec

program.main(build, duration=0.02)
"""


def test_what_a_pass_ran_in_is_part_of_its_evidence(level, make, finish, evidence):
    run = make(GOOD)
    job = finish(run)
    assert job.state == "succeeded", job.text()
    facts = json.loads((evidence(run) / "physics/environment.json").read_text())
    assert {"python", "engine", "gl", "cpu features", "wheel mujoco"} <= set(facts)
    result = json.loads((evidence(run) / "physics/result.json").read_text())
    assert "environment.json" in result["files"]
    assert result["confinement"]["births"]


def test_an_environment_that_changed_after_the_start_is_a_typed_refusal(make, finish, evidence, monkeypatch):
    run = make(GOOD)
    monkeypatch.setattr("worldkit.lock.observe", lambda gl=None: {"python": "CPython 2.7", "gl": "glx"})
    job = finish(run)
    assert (job.state, job.code) == ("failed", "environment"), job.text()
    assert "CPython 2.7" in job.message
    assert "gl: " in job.message
    assert job.next_move
    assert not (evidence(run) / "physics").exists()


def test_a_pinned_run_is_refused_elsewhere(make, finish):
    run = make(GOOD)
    pinned = run.folder / "environment.lock"
    assert CliRunner().invoke(main, ["doctor", "--lock", str(pinned)]).exit_code == 0
    assert finish(run).state == "succeeded"
    facts = json.loads(pinned.read_text())
    pinned.write_text(json.dumps({**facts, "wheel numpy": "1.26.0 0000"}))
    with pytest.raises(GateError, match=r"wheel numpy: .* \(locked: 1.26.0 0000\)"):
        start(str(run.folder), force=True)
    pinned.write_text("[broken")
    with pytest.raises(GateError, match="cannot be read"):
        start(str(run.folder), force=True)
    assert Job.find(run, None).read().state == "succeeded"
