"""What is driven: the accepted world as it was stamped, else the one that was recorded last; nothing that is neither."""

import hashlib
import json
import shutil
from pathlib import Path

import pytest

from worldwright.ends.live_source import LiveSource
from worldwright.ends.witness import Witness
from worldwright.model.errors import GateError
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import PassResult
from worldwright.model.evidence.run import Run
from worldwright.stamp import departures

EXAMPLE = Path(__file__).parents[3] / "examples/slack-rope-pulls-box"


@pytest.fixture
def recorded(roped, tmp_path):
    """The roped box as its physics pass leaves it, never accepted."""
    folder = tmp_path / "rope"
    folder.mkdir()
    for name in ("plan.md", "simulation.py"):
        shutil.copy(EXAMPLE / name, folder)
    run = Run(folder)
    key = run.evidence_key(environment.current().sha256())
    physics = run.evidence(key) / "physics"
    shutil.copytree(roped.recording.folder, physics / "trajectory")
    shutil.copy(roped.run / "accepted/world.mjz", physics)
    for name in ("program.json", "inputs.json"):
        shutil.copy(roped.run / "accepted/world" / name, physics)
    files = {
        name: hashlib.sha256((physics / name).read_bytes()).hexdigest()
        for name in ("world.mjz", "program.json", "inputs.json")
    }
    result = PassResult(stage="physics", ok=True, files=files, summary={"world_sha256": files["world.mjz"]})
    (physics / "result.json").write_text(result.model_dump_json())
    told = hashlib.sha256((physics / "result.json").read_bytes()).hexdigest()
    run.log("stage", "stage", key=key.key, stage="physics", result_sha256=told)
    return folder


def test_an_accepted_world_is_the_one_that_was_stamped(roped):
    source = LiveSource.find(roped.run)
    assert source.world == roped.run / "accepted/world.mjz" and source.stamp_sha256 and source.poses() == (None, None)
    assert source.drove == roped.run / "accepted/world" and source.given.duration == 4.0


def test_a_recorded_world_is_driven_before_it_is_accepted(recorded):
    source = LiveSource.find(recorded)
    assert source.world.parent.name == "physics" and not source.stamp_sha256 and source.plan.topology
    assert source.drove == source.world.parent / "trajectory" and source.poses()[0].shape[1:] == (3, 3)
    with source.world.open("ab") as world:
        world.write(b"x")
    with pytest.raises(GateError, match=r"world\.mjz is not what was recorded"):
        LiveSource.find(recorded)
    (recorded / "plan.md").write_text((recorded / "plan.md").read_text() + "\n")
    with pytest.raises(GateError, match="no recording of this program and plan"):
        LiveSource.find(recorded)


def test_a_recording_that_no_line_of_the_journal_vouches_for_is_not_driven(recorded):
    (result,) = recorded.glob("evidence/*/physics/result.json")
    with (result.parent / "program.json").open("ab") as facts:
        facts.write(b"\n")
    said = json.loads(result.read_bytes())
    said["files"]["program.json"] = hashlib.sha256((result.parent / "program.json").read_bytes()).hexdigest()
    result.write_text(json.dumps(said))
    with pytest.raises(GateError, match="no line of the journal vouches for what was recorded"):
        LiveSource.find(recorded)
    journal = recorded / "journal.jsonl"
    sha256 = hashlib.sha256(result.read_bytes()).hexdigest()
    (line,) = [json.loads(row) for row in journal.read_text().splitlines()]
    journal.write_text(json.dumps({**line, "result_sha256": sha256}) + "\n")
    with pytest.raises(GateError, match="the journal is not as it was written"):
        LiveSource.find(recorded)


def test_what_is_driven_of_a_world_that_is_not_the_plans_is_not_signed(recorded, monkeypatch, tmp_path):
    assert LiveSource.find(recorded).doubt == ""
    monkeypatch.setattr(departures, "from_plan", lambda world, plan: ["WM163 the box weighs 3 kg"])
    source = LiveSource.find(recorded)
    assert "WM163" in source.doubt
    (tmp_path / "begun").mkdir()
    (tmp_path / "begun/begun.json").write_text("{}")
    witness = Witness(tmp_path, {}, source.doubt)
    witness.ended()
    assert "WM163" in witness.contradicts({})


def test_what_was_changed_since_it_was_stamped_is_not_driven(roped, tmp_path):
    shutil.copytree(roped.run, tmp_path / "rope")
    with (tmp_path / "rope/accepted/world.mjz").open("ab") as world:
        world.write(b"x")
    with pytest.raises(GateError, match=r"world\.mjz is not what the stamp lists"):
        LiveSource.find(tmp_path / "rope")
