"""What a drive leaves is believed only as far as a replay finds it again; forged, torn and linked folders are refused with a cause."""

import json
import shutil
import time

import numpy as np
import pytest
from click.testing import CliRunner

from worldengine.clock.physics import meeting
from worldengine.recording import stored
from worldwright import driven_worlds
from worldwright.ends import drive_film, drive_folder, driven
from worldwright.ends.live_source import LiveSource
from worldwright.ends.live_world import LiveWorld
from worldwright.model.errors import GateError, JobError, NotFoundError
from worldwright.stamp import signing


def until(true):
    end = time.monotonic() + 60
    while not true():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.01)


@pytest.fixture(scope="module")
def ended(roped, tmp_path_factory):
    """A drive that has ended, not proved yet; its length is no multiple of the steps between two rows."""
    run = tmp_path_factory.mktemp("ended") / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    world = LiveWorld(LiveSource.find(run), seconds=0.333, waits=False)
    with pytest.raises(GateError, match="still runs"):
        driven.finish(world.folder)
    (world.folder / driven.EVENTS).write_text(
        '{"what": "came"}\n{"what": "drives", "name": "Ada\\u001b[2J", "where": "here", "from_s": 0.0}\n{"what": "rel'
    )
    assert world.wait(60)
    world.close()
    return world.folder


@pytest.fixture(scope="module")
def stated(ended, tmp_path_factory):
    run = tmp_path_factory.mktemp("stated") / "rope"
    shutil.copytree(ended.parents[1], run)
    folder = run / "drives" / ended.name
    assert driven.finish(folder).vouched
    return folder


def copied(folder, place):
    shutil.copytree(folder.parents[1], place / "rope")
    return place / "rope/drives" / folder.name


def rewritten(path, change):
    said = json.loads(path.read_bytes())
    change(said)
    path.write_text(json.dumps(said))


def test_a_forged_statement_is_not_believed(stated, tmp_path):
    folder = copied(stated, tmp_path)
    for name in (signing.ENVELOPE, signing.PUBLIC):
        (folder / name).unlink()
    told = CliRunner().invoke(driven_worlds.command, ["prove", str(folder)])  # proved, but anybody can have stated it
    assert told.exit_code == 3 and "UNSIGNED" in told.output and "all 4 rows" in told.output
    right = (folder / driven.STATEMENT).read_bytes()
    for name, value in (("rows", 999999), ("inputs_sha256", "00")):
        rewritten(folder / driven.STATEMENT, lambda said, n=name, v=value: said["predicate"].update({n: v}))
        with pytest.raises(GateError, match=f"{name} is stated as {value}"):
            driven.prove(folder)
        (folder / driven.STATEMENT).write_bytes(right)
    shutil.rmtree(folder / "live")
    rewritten(
        folder / driven.STATEMENT,
        lambda said: said.update(subject=[row for row in said["subject"] if not row["name"].startswith("live/")]),
    )
    with pytest.raises(GateError, match="nothing can be compared"):
        driven.prove(folder)


def test_what_no_run_began_is_not_signed(ended, tmp_path):
    folder = copied(ended, tmp_path)
    shutil.copytree(folder, tmp_path / "aside")
    with pytest.raises(GateError, match="no folder of a run's drives"):
        driven.finish(tmp_path / "aside")
    plan = (folder / "plan.md").read_bytes()
    (folder / "plan.md").write_bytes(plan + b"\n")
    with pytest.raises(GateError, match=r"plan\.md is not what the drive began with"):
        driven.finish(folder)
    (folder / "plan.md").write_bytes(plan)
    rewritten(folder / drive_folder.BEGUN, lambda said: said.update(stamp_sha256="of another world"))
    found = driven.finish(folder)
    assert not found.vouched and "did not sign how it began" in found.signed
    rewritten(folder / drive_folder.BEGUN, lambda said: said.update(rows=999))
    with pytest.raises(GateError, match=r"begun\.json makes no sense: rows"):
        driven.finish(folder)


def test_another_recording_is_not_filmed_and_prove_puts_its_own_there(stated, tmp_path):
    folder = copied(stated, tmp_path)
    states = folder / "physics/trajectory/state.arrows"
    content = bytearray(states.read_bytes())
    time_s = np.array(stored.open(folder / "physics/trajectory").time[:9])
    at = content.index(time_s.tobytes())
    content[at : at + 8] = np.float64(1e-9).tobytes()
    states.write_bytes(content)
    with pytest.raises(GateError, match="another recording lies here"):
        drive_film.film(folder)
    driven.prove(folder)
    assert states.read_bytes() == (stated / "physics/trajectory/state.arrows").read_bytes()


@pytest.mark.parametrize("lost", [("live/result.json",), ("live/result.json", "live/trajectory/complete.json")])
def test_a_kill_at_the_end_loses_nothing(ended, tmp_path, lost):
    folder = copied(ended, tmp_path)
    for name in lost:
        (folder / name).unlink()
    found = driven.finish(folder)
    assert found.simulated_s == pytest.approx(0.333) and found.rows == found.rows_live == 4
    assert found.complete == (len(lost) == 1)


def linked(name):
    def change(folder):
        shutil.move(folder / name, folder.parents[2] / "elsewhere")
        (folder / name).symlink_to(folder.parents[2] / "elsewhere")

    return change


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda folder: (folder / driven.EVENTS).write_text("[1]\n{}\n"), "line 1 makes no sense"),
        (lambda folder: (folder / driven.EVENTS).write_text('{"what": "drives"}\n'), "line 1 makes no sense: name"),
        (lambda folder: (folder / driven.EVENTS).write_bytes(b"\xff\n{}\n"), "line 1 makes no sense"),
        (lambda folder: (folder / driven.STATEMENT).write_text("{}"), r"drive\.json makes no sense"),
        (lambda folder: (folder / drive_folder.BEGUN).write_text("{}"), r"begun\.json makes no sense"),
        (lambda folder: (folder / "live/trajectory/meta.json").write_text('{"sch'), "makes no sense"),
        (linked("live"), "a link"),
    ],
)
def test_what_makes_no_sense_is_told(ended, tmp_path, change, said):
    folder = copied(ended, tmp_path)
    change(folder)
    with pytest.raises(GateError, match=said):
        driven.prove(folder)


def test_the_list_prints_no_sign_that_moves_the_cursor(stated):
    told = CliRunner().invoke(driven_worlds.command, ["list", str(stated.parents[1])])
    assert told.exit_code == 0 and "Ada\\u001b[2J" in told.output and "\x1b" not in told.output


def test_what_was_never_driven_hides_no_earlier_drive(stated, tmp_path, monkeypatch):
    folder = copied(stated, tmp_path)
    run = folder.parents[1]
    world = LiveWorld(LiveSource.find(run))
    world.close()
    assert not world.folder.exists()
    monkeypatch.setattr("worldwright.ends.live_world.call", lambda _: ["false"])
    with pytest.raises(JobError, match="did not begin"):
        LiveWorld(LiveSource.find(run))
    assert [path.name for path in (run / "drives").iterdir()] == [folder.name]
    (folder / driven.STATEMENT).unlink()
    shutil.rmtree(folder / "live")
    with pytest.raises(NotFoundError, match="there is no drive"):
        driven.find(run)


def test_a_long_replay_has_rows_where_the_live_ones_are():
    assert [meeting(every, 128) for every in (1, 3, 128, 200, 257)] == [1, 4, 128, 256, 384]
    assert meeting(7, 1) == 7
