"""Variants: the same program run again with a difference, kept beside the evidence."""

import json

import pytest

from worldwright.model.errors import GateError, JobError
from worldwright.stage.tools import run_variant, start, variant_folder

VARIED = """
import json, pathlib, sys
out = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
(out / "trajectory").mkdir()
(out / "trajectory" / "complete.json").write_text("{}")
if "--explode" in sys.argv:
    raise ValueError("no cause")
factor = float(sys.argv[sys.argv.index("--factor") + 1]) if "--factor" in sys.argv else 1.0
(out / "result.json").write_text(json.dumps({"ok": True, "trajectory_sha256": str(factor)}))
"""


def test_a_variant_stands_beside_the_evidence_and_is_never_paid_twice(make, finish, evidence):
    run = make(VARIED)
    with pytest.raises(GateError, match="physics pass has not succeeded"):
        run_variant(run, "half-step", ("--factor", "0.5"))
    assert finish(run).state == "succeeded"
    before = (evidence(run) / "physics/result.json").read_bytes()
    assert variant_folder(run, "half-step") is None
    job = run_variant(run, "half-step", ("--factor", "0.5"))
    assert (job.state, job.cached, job.variant) == ("succeeded", False, "half-step"), job.text()
    folder = variant_folder(run, "half-step")
    assert folder == evidence(run) / "physics@half-step"
    result = json.loads((folder / "result.json").read_text())
    assert (result["variant"], result["arguments"]) == ("half-step", ["--factor", "0.5"])
    assert result["summary"]["trajectory_sha256"] == "0.5"
    assert run_variant(run, "half-step", ("--factor", "0.5")).cached
    assert (evidence(run) / "physics/result.json").read_bytes() == before
    assert start(str(run.folder)).cached
    assert [e["stage"] for e in run.entries() if e["action"] == "stage"] == ["physics", "physics@half-step"]
    with pytest.raises(JobError, match="made with"):
        run_variant(run, "half-step", ("--factor", "0.25"))


def test_a_variant_that_fails_says_how_and_leaves_nothing(make, finish, evidence):
    run = make(VARIED)
    finish(run)
    job = run_variant(run, "without-foot", ("--explode",))
    assert (job.state, job.code) == ("failed", "crashed")
    assert variant_folder(run, "without-foot") is None
    assert not (evidence(run) / "physics@without-foot").exists()


@pytest.mark.parametrize("name", ["", "../up", "Half", "a/b", "a" * 81, ".hidden"])
def test_a_name_that_could_leave_its_folder_is_refused(make, name):
    with pytest.raises(JobError, match="no name for a variant"):
        run_variant(make(VARIED), name, ())
