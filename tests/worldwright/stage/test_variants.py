"""Variants: the same program run again with a difference, kept beside the evidence."""

import json

import pytest

from worldwright.model.errors import GateError, JobError
from worldwright.stage.tools import run_variant, start, variant_folder

VARIED = """
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
FINER = ("--time-step-factor", "0.5")


def test_a_variant_stands_beside_the_evidence_and_is_never_paid_twice(make, finish, evidence):
    run = make(VARIED)
    with pytest.raises(GateError, match="physics pass has not succeeded"):
        run_variant(run, "half-step", FINER)
    assert finish(run).state == "succeeded"
    before = (evidence(run) / "physics/result.json").read_bytes()
    assert variant_folder(run, "half-step") is None
    job = run_variant(run, "half-step", FINER)
    assert (job.state, job.cached, job.variant) == ("succeeded", False, "half-step"), job.text()
    folder = variant_folder(run, "half-step")
    assert folder == evidence(run) / "physics@half-step"
    result = json.loads((folder / "result.json").read_text())
    assert (result["variant"], result["arguments"]) == ("half-step", list(FINER))
    assert result["summary"]["steps"] == 20
    assert "world.mjz" not in result["files"]  # it is the one of the pass that is varied
    assert run_variant(run, "half-step", FINER).cached
    assert (evidence(run) / "physics/result.json").read_bytes() == before
    assert start(str(run.folder)).cached
    assert [e["stage"] for e in run.entries() if e["action"] == "stage"] == ["physics", "physics@half-step"]
    with pytest.raises(JobError, match="made with"):
        run_variant(run, "half-step", ("--time-step-factor", "0.25"))


def test_a_variant_that_fails_says_how_and_leaves_nothing(make, finish, evidence):
    run = make(VARIED)
    finish(run)
    job = run_variant(run, "without-foot", ("--without", "foot"))
    assert (job.state, job.code) == ("failed", "program")
    assert variant_folder(run, "without-foot") is None
    assert not (evidence(run) / "physics@without-foot").exists()


@pytest.mark.parametrize("name", ["", "../up", "Half", "a/b", "a" * 81, ".hidden"])
def test_a_name_that_could_leave_its_folder_is_refused(make, name):
    with pytest.raises(JobError, match="no name for a variant"):
        run_variant(make(VARIED), name, ())
