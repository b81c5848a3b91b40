"""What a drive leaves is believed only as far as a replay finds it again; forged, torn and linked folders are refused with a cause."""

import dataclasses
import json
import os
import shutil
import sys
import tempfile
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
from worldwright.ends.witness import Witness
from worldwright.model.errors import GateError, JobError, NotFoundError
from worldwright.model.evidence.run import sha256_file
from worldwright.stamp import keyring, signing


def until(true):
    end = time.monotonic() + 60
    while not true():
        assert time.monotonic() < end, "it never came true"
        time.sleep(0.01)


@pytest.fixture(scope="module")
def lived(roped, tmp_path_factory):
    """A drive that has ended, not proved yet, and what its process saw; its length is no multiple of the steps between two rows."""
    run = tmp_path_factory.mktemp("ended") / "rope"
    shutil.copytree(roped.run, run, ignore=shutil.ignore_patterns("drives"))
    world = LiveWorld(LiveSource.find(run), seconds=0.333, waits=False)
    with pytest.raises(GateError, match="still runs"):
        driven.prove(world.folder)
    world.witness.note("came", {})
    world.witness.note("drives", {"name": "Ada\x1b[2J", "where": "here", "from_s": 0.0})
    assert world.wait(60)
    world.close()
    return world.folder, world.witness


@pytest.fixture(scope="module")
def ended(lived):
    return lived[0]


@pytest.fixture(scope="module")
def stated(lived, tmp_path_factory):
    """The same, finished and signed by its live run."""
    ended, witness = lived
    run = tmp_path_factory.mktemp("stated") / "rope"
    shutil.copytree(ended.parents[1], run)
    folder = run / "drives" / ended.name
    assert driven.finish(folder, witness).vouched
    return folder


def told(*words):
    return CliRunner().invoke(driven_worlds.command, list(map(str, words)))


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
    proved = told("prove", folder)  # proved, but anybody can have stated it
    assert proved.exit_code == 3 and "UNSIGNED" in proved.output and "all 4 rows" in proved.output
    assert "UNSIGNED" in told("list", folder.parents[1]).output
    rewritten(folder / driven.STATEMENT, lambda said: said["predicate"].update(rows=999999))
    with pytest.raises(GateError, match="rows is stated as 999999"):
        driven.prove(folder)
    shutil.rmtree(folder / "live")
    rewritten(
        folder / driven.STATEMENT,
        lambda said: said.update(subject=[row for row in said["subject"] if not row["name"].startswith("live/")]),
    )
    with pytest.raises(GateError, match="nothing can be compared"):
        driven.prove(folder)


ODD = ({"why": []}, {"overruns": -1}, {"worst_s": "soon"}, {"more": 1}, "late", None, [1])


@pytest.mark.parametrize("signed", [True, False])
def test_whatever_is_wrong_in_a_statement_is_told_by_list_and_film_and_prove(stated, tmp_path, signed):
    """Each field in turn: nothing of it is believed, and nothing ends in a traceback."""
    folder = copied(stated, tmp_path)
    if not signed:
        for name in (signing.ENVELOPE, signing.PUBLIC):
            (folder / name).unlink()
    right = json.loads((folder / driven.STATEMENT).read_bytes())
    of_replay = {"rows", "trajectory_sha256", "witnessed"}
    wrong = [("pace", value) for value in ODD]
    wrong += [(name, value) for name in right["predicate"] for value in ("x", 7, -1, {}, [{}], None)]
    wrong += [("driven_by", [{"driver": "Eve", "where": "here", "from_s": 0.0, "to_s": 0.333}]), ("simulated_s", 9e9)]
    for name, value in wrong:
        if right["predicate"][name] == value or (not signed and name in of_replay and value in ("x", 7)):
            continue  # this is what only a replay, or the signature, tells
        said = {**right, "predicate": {**right["predicate"], name: value}}
        (folder / driven.STATEMENT).write_text(json.dumps(said))
        with pytest.raises(GateError):
            driven.checked(folder)
        for verb in ("prove", "film"):
            found = told(verb, folder)
            assert found.exit_code == 2 and "next: " in found.output, (name, value, found.output)
        listed = told("list", folder.parents[1])
        assert listed.exit_code == 0 and " s, " not in listed.output, listed.output


def test_only_the_process_that_ran_it_signs(stated, lived, tmp_path):
    folder = copied(stated, tmp_path)
    events = folder / driven.EVENTS
    events.write_bytes(events.read_bytes().replace(b"Ada", b"Eve"))
    assert told("prove", folder).exit_code == 2 and "events.jsonl is not what" in told("list", folder.parents[1]).output
    for name in (driven.STATEMENT, signing.ENVELOPE, signing.PUBLIC):
        (folder / name).unlink()
    found = told("prove", folder)
    assert found.exit_code == 3 and "NOT SIGNED BY THE LIVE RUN" in found.output and "bit for bit" in found.output
    assert not (folder / signing.ENVELOPE).exists() and not drive_folder.statement(folder).predicate.witnessed
    listed = told("list", folder.parents[1]).output
    assert "Eve" in listed and "NOT SIGNED BY THE LIVE RUN" in listed
    signing.sign(folder, driven.STATEMENT, keyring.own())
    assert not driven.checked(folder).vouched, "a signature that comes later does not make it a witness's"
    (folder / driven.STATEMENT).unlink()
    found = driven.finish(folder, lived[1])
    assert not found.vouched and "events.jsonl is not what it left" in found.signed


def test_a_drive_beside_another_plan_is_told_apart(stated, tmp_path):
    folder = copied(stated, tmp_path)
    run = folder.parents[1]
    assert driven.checked(folder).apart == ""
    for place in (run, run / "accepted"):
        with (place / "plan.md").open("a") as plan:
            plan.write("\n")
    (run / "accepted/stamp.json").write_text("{}")
    moved = run.rename(run.with_name("ramp"))
    (said,) = told("list", moved).output.splitlines()
    assert "`rope` was driven, and it lies in `ramp`" in said and "its plan is another" in said
    assert "the accepted world that was driven is not the one" in said
    assert "NOT OF THIS RUN AS IT IS: `rope`" in told("prove", moved / "drives" / folder.name).output


def test_a_disk_that_was_full_for_a_moment_costs_one_line_and_not_the_signature(tmp_path):
    class Full:
        """Takes half of a line, and no more until there is room again."""

        def __init__(self, log):
            self.log, self.room = log, 1

        def write(self, data):
            if self.room == 0:
                raise OSError(28, "No space left on device")
            self.room -= 1
            return self.log.write(bytes(data)[:9])

        def __getattr__(self, name):
            return getattr(self.log, name)

    (tmp_path / "begun").mkdir()
    (tmp_path / drive_folder.BEGUN).write_text("{}")
    witness = Witness(tmp_path, {})
    witness.note("came", {})
    before, log = (tmp_path / driven.EVENTS).read_bytes(), witness._log
    witness._log = Full(log)
    with pytest.raises(OSError, match="No space"):
        witness.note("drives", {"name": "Ada"})
    witness._log = log
    assert (tmp_path / driven.EVENTS).read_bytes() == before
    witness.note("released", {"to_s": 1.0})
    witness.ended()
    assert not witness.contradicts({name: sha256_file(tmp_path / name) for name in (driven.EVENTS, drive_folder.BEGUN)})


def test_a_kill_while_it_is_signed_leaves_a_drive_that_is_proved(stated, tmp_path):
    folder = copied(stated, tmp_path)
    room = folder / driven.SEALING
    room.mkdir()
    (folder / driven.STATEMENT).rename(room / driven.STATEMENT)
    assert "not proved yet" in told("list", folder.parents[1]).output
    assert driven.prove(folder).vouched and not room.exists()


def test_what_no_run_began_is_not_proved(ended, tmp_path):
    folder = copied(ended, tmp_path)
    shutil.copytree(folder, tmp_path / "aside")
    with pytest.raises(GateError, match="no folder of a run's drives"):
        driven.prove(tmp_path / "aside")
    plan = (folder / "plan.md").read_bytes()
    (folder / "plan.md").write_bytes(plan + b"\n")
    with pytest.raises(GateError, match=r"plan\.md is not what the drive began with"):
        driven.prove(folder)
    (folder / "plan.md").write_bytes(plan)
    rewritten(folder / drive_folder.BEGUN, lambda said: said.update(rows=999))
    with pytest.raises(GateError, match=r"begun\.json makes no sense: rows"):
        driven.prove(folder)


def test_a_world_that_is_not_the_stamps_when_its_drive_begins_is_not_driven(ended):
    source = LiveSource.find(ended.parents[1])
    assert set(source.digests) == {"world.mjz", "plan.md", "facts.json", "inputs.json"}
    before = sorted(path.name for path in ended.parent.iterdir())
    for name in source.digests:
        swapped = dataclasses.replace(source, digests={**source.digests, name: "0" * 64})
        with pytest.raises(GateError, match=f"{name} changed while the drive began"):
            LiveWorld(swapped)
    assert sorted(path.name for path in ended.parent.iterdir()) == before


PROBE = """
import json, os, socket, sys
from pathlib import Path
said = dict(zip(sys.argv[1::2], sys.argv[2::2]))
out, tried = Path(said["--out"]), {}
def attempt(name, act):
    try:
        tried[name] = repr(act())
    except OSError as no:
        tried[name] = ""
attempt("network", lambda: socket.socket(socket.AF_INET, socket.SOCK_DGRAM))
attempt("the signing key", lambda: Path(KEY).read_bytes())
attempt("another run", lambda: Path(OTHER).read_bytes())
attempt("its own drive", lambda: (Path(said["--world"]).parent / "events.jsonl").read_bytes())
attempt("writes", lambda: (Path(said["--world"]).parent / "more").write_text("x"))
attempt("a shared tmp", lambda: os.listdir(SHARED))
tried["variables"] = [os.environ["HOME"], os.environ["TMPDIR"]]
(out / "error.json").write_text(json.dumps({"message": json.dumps(tried)}))
"""


def test_the_live_engine_is_confined(ended, tmp_path, monkeypatch):
    run = copied(ended, tmp_path).parents[1]
    (tmp_path / "another").mkdir()
    (tmp_path / "another/plan.md").write_text("mine")
    keyring.own()
    words = {"KEY": str(keyring.folder() / keyring.OWN), "OTHER": str(tmp_path / "another/plan.md")}
    words["SHARED"] = tempfile.gettempdir()
    script = "".join(f"{name} = {value!r}\n" for name, value in words.items()) + PROBE
    monkeypatch.setattr("worldwright.ends.live_world.call", lambda rest: [sys.executable, "-c", script, *rest[1:]])
    with pytest.raises(JobError) as told:
        LiveWorld(LiveSource.find(run))
    tried = json.loads(told.value.cause.partition("begin: ")[2])
    home, temporary = tried.pop("variables")
    shared = tried.pop("a shared tmp")
    assert not any(tried.values()), tried
    assert home == temporary != tempfile.gettempdir() and not os.path.exists(home)  # noqa: PTH110
    assert str(tmp_path.name) not in shared and "worldwright-confined" not in shared


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
    found = driven.prove(folder)
    assert not found.vouched and found.simulated_s == pytest.approx(0.333) and found.rows == found.rows_live == 4
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
        (lambda folder: rewritten(folder / "live/result.json", lambda said: said.update(why=[1])), "why"),
        (lambda folder: (folder / "live/result.json").write_text('{"overruns": NaN}'), "overruns"),
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
    listed = told("list", stated.parents[1])
    assert listed.exit_code == 0 and "Ada\\u001b[2J" in listed.output and "\x1b" not in listed.output
    assert "signed by this machine's key" in listed.output


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
