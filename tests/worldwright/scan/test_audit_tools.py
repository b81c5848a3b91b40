"""The audits through the tools, on a run whose physics passes really ran in the sandbox."""

import json

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import NotFoundError
from worldwright.model.evidence.audits import CausesReport, InterventionReport, RefineReport
from worldwright.model.evidence.run import Run
from worldwright.scan import tools
from worldwright.stage import tools as stage
from worldwright.stamp import tools as stamp


@pytest.fixture(scope="module")
def run(planned, tmp_path_factory):
    """A dropped ball whose fall is claimed to be gravity's doing, with its physics recorded."""
    import shutil

    folder = tmp_path_factory.mktemp("audited") / planned.name
    shutil.copytree(planned, folder)
    plan = (folder / "plan.md").read_text()
    (folder / "plan.md").write_text(plan.replace("The ball falls to the floor.", "The ball falls.\n  cause: gravity"))
    stamp.approve(str(folder), by="tester")
    assert lint.check_program([folder / "simulation.py"]).ok
    job = stage.start(str(folder), stage="physics")
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text()
    return folder


def evidence(folder, name, kind):
    (path,) = folder.glob(f"evidence/*/{name}.json")
    return kind.model_validate_json(path.read_text())


def test_every_scan_keeps_the_ledger(run):
    found = tools.scan(str(run))
    assert found.ok, found.text()
    report = evidence(run, "interventions", InterventionReport)
    assert report.ok and report.acting == () and report.trajectory_sha256 == found.trajectory_sha256
    assert report.load_paths[0].bodies == ("world", "ball")
    assert report.load_paths[0].impulse_n_s > 0.2


def test_both_audits_end_in_evidence_and_go_on_where_they_stopped(run):
    first = tools.scan(str(run), refine=True, causes=True, timeout_s=0)
    assert first.pending and not first.ok and "call again" in first.text()
    found = first
    for _ in range(10):
        if not found.pending:
            break
        found = tools.scan(str(run), refine=True, causes=True, timeout_s=20)
    assert found.ok, found.text()
    refined, causes = evidence(run, "refine", RefineReport), evidence(run, "causes", CausesReport)
    assert refined.ok and refined.claims[0].at_finer == "holds"
    (cause,) = causes.causes
    assert (cause.cause, cause.outcome, cause.effect) == ("gravity", "caused", "falls")
    assert {trial.label for trial in causes.trials} >= {"without gravity", "weaken gravity=0.8", "weaken gravity=0.5"}
    assert len(json.dumps(found.model_dump(mode="json"))) < 20_000
    actions = [entry["action"] for entry in Run(run).entries()]
    assert "refine" in actions and "causes" in actions
    assert tools.unlike_trials(Run(run), {"refine": refined, "causes": causes}) == []
    told = refined.model_copy(update={"refined_sha256": "0" * 64})
    (found,) = tools.unlike_trials(Run(run), {"refine": told})
    assert found.startswith("refine.json says refined_sha256 is 0000")


def test_a_repetition_that_fails_ends_the_audit_with_its_reason(run, tmp_path):
    import shutil

    folder = tmp_path / run.name
    shutil.copytree(run, folder)
    plan = (folder / "plan.md").read_text()
    (folder / "plan.md").write_text(plan.replace("cause: gravity", "cause: the_moon"))
    stamp.approve(str(folder), by="tester")
    assert lint.check_program([folder / "simulation.py"]).ok
    job = stage.start(str(folder), stage="physics")
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=30)
    for _ in range(40):  # each call too short for a repetition to end in it
        found = tools.scan(str(folder), causes=True, timeout_s=0.3)
        if not found.pending:
            break
    assert not found.pending and not found.ok
    (cause,) = found.causes.causes
    assert cause.outcome == "unclear" and "there is no the_moon" in cause.message and "ball" in cause.message
    assert [a.code for a in found.causes.anomalies] == ["WS324"]


def test_a_lone_recording_cannot_be_repeated(run):
    (recording,) = run.glob("evidence/*/physics/trajectory")
    assert not [a for a in tools.scan(str(recording)).anomalies if a.severity == "blocking"]
    with pytest.raises(NotFoundError, match="no program to repeat"):
        tools.scan(str(recording), causes=True)
