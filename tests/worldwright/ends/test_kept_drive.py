"""A drive kept as a run: its program gives the commands again, through the rows that were recorded live, bit for bit."""

import runpy
import shutil
import subprocess
import sys
import types
from pathlib import Path

import numpy as np
import pytest
from click.testing import CliRunner

from worldwright import driven_worlds
from worldwright.ends import drive_folder, driven, kept_drive
from worldwright.ends.live_source import LiveSource
from worldwright.ends.live_world import LiveWorld
from worldwright.lint.tools import check_program
from worldwright.model.errors import GateError
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.storage import StorageError

CAR = Path(__file__).parents[1] / "world/driven_car_plan.md"


@pytest.fixture(scope="module")
def drive(roped, tmp_path_factory):
    run = tmp_path_factory.mktemp("kept") / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    world = LiveWorld(LiveSource.find(run), speed=4.0, seconds=0.9)
    world.witness.note("drives", {"name": 'Ada "\\n#: {x}', "where": "here", "from_s": 0.0})
    while not world.wait(0.02):
        world.command({"pull": 0.2})
    world.close()
    assert driven.finish(world.folder, world.witness).vouched
    return world.folder


@pytest.fixture(scope="module")
def kept(drive, tmp_path_factory):
    run = tmp_path_factory.mktemp("run") / "driven"
    told = CliRunner().invoke(driven_worlds.command, ["keep", str(drive), "--as", str(run)])
    assert told.exit_code == 0 and "worldwright go" in told.output, told.output
    return run


def test_a_kept_drive_is_a_run_that_moves_as_it_was_driven(drive, kept):
    plan = read_plan(kept / "plan.md").plan.simulation_parameters
    assert plan.simulation_duration == pytest.approx(0.9)
    assert (
        "driven live by Ada" in plan.interventions[0].law and "signed by the live run" in plan.interventions[0].source
    )
    found = check_program([kept / "simulation.py"], model=False).findings  # the plan's claims are of a longer motion
    assert not [finding for finding in found if finding.severity == "error" and finding.code.startswith("WL")], found
    out = kept / "out"
    call = [sys.executable, str(kept / "simulation.py"), "--pass", "physics", "--out", str(out)]
    subprocess.run(call, check=True, capture_output=True)
    recording = out / "trajectory"
    rows = len(kept_drive.drive_replay.recorded(drive).time)
    assert kept_drive.same(recording, drive) == rows > 5
    told = (kept / "simulation.py").read_text().replace("VALUES[min(", "0.9 * VALUES[min(")
    (kept / "simulation.py").write_text(told)
    shutil.rmtree(out)
    subprocess.run(call, check=True, capture_output=True)
    with pytest.raises(GateError, match="other states than the drive"):
        kept_drive.same(recording, drive)


def test_a_world_whose_clock_begins_late_is_asked_its_first_question_first(drive, tmp_path):
    facts = drive_folder.facts(drive, "program.json")
    text = kept_drive.program_text(facts, driven.checked(drive), 0.001, 5.0)
    (tmp_path / kept_drive.NAMES).write_text("{}")
    np.savez(tmp_path / kept_drive.COMMANDS, controls=[0], values=[[1.0], [2.0], [3.0]])
    (tmp_path / "simulation.py").write_text(text)
    program = runpy.run_path(str(tmp_path / "simulation.py"))
    every = program["EVERY"]
    data = types.SimpleNamespace(time=5.0, ctrl=np.zeros(1))
    for step, value in ((0, 1.0), (every, 2.0), (2 * every, 3.0)):
        data.time = 5.0 + 0.001 * step
        program["control"](None, data)
        assert data.ctrl[0] == value


def test_a_run_that_cannot_be_made_whole_leaves_nothing(drive, tmp_path, monkeypatch):
    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(kept_drive, "write_atomic", full)
    with pytest.raises(StorageError):
        kept_drive.keep(drive, tmp_path / "new")
    assert not list(tmp_path.iterdir())


def test_a_car_that_followed_a_path_is_declared_to_be_driven(drive, tmp_path):
    shutil.copytree(drive, tmp_path / "drive")
    (tmp_path / "drive/plan.md").write_bytes(CAR.read_bytes())
    (tmp_path / "plan.md").write_text(kept_drive.plan_text(tmp_path / "drive", driven.checked(drive)))
    plan = read_plan(tmp_path / "plan.md").plan
    (row,) = plan.simulation_parameters.interventions
    assert (
        "car_drive" in row.bodies
        and "driven live by Ada" in row.law
        and "follows:" not in (tmp_path / "plan.md").read_text()
    )


def test_what_cannot_be_kept_is_told_with_the_next_move(drive, kept, tmp_path):
    told = CliRunner().invoke(driven_worlds.command, ["keep", str(drive), "--as", str(kept)])
    assert told.exit_code == 2 and "is there already" in told.output
    shutil.copytree(drive.parents[1], tmp_path / "rope")
    folder = tmp_path / "rope/drives" / drive.name
    (folder / driven.STATEMENT).unlink()
    told = CliRunner().invoke(driven_worlds.command, ["keep", str(folder), "--as", str(tmp_path / "new")])
    assert told.exit_code == 2 and "not proved yet" in told.output and not (tmp_path / "new").exists()
    told = CliRunner().invoke(driven_worlds.command, ["keep", str(drive), "--as", str(kept), "--check"])
    assert told.exit_code == 2 and "no recording" in told.output
