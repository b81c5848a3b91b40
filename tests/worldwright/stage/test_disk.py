"""What can be made again of a run is freed; evidence of what stands, of what was accepted, and running jobs never are."""

import fcntl
import resource
import subprocess
import time

import pytest
from click.testing import CliRunner

from worldkit.files import write_json
from worldwright import freeing
from worldwright.model.errors import GateError
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.stage import disk, family
from worldwright.stage.job import Job, JobStatus, Spec
from worldwright.stage.tools import status


def key_of(run):
    return run.evidence_key(environment.current().sha256())


def recorded(run, size=300_000, started="2026-01-01"):
    """Evidence of the program as it stands: a recording, a trial, a picture and a report; returns its folder."""
    folder = run.evidence(key_of(run))
    for name in ("physics/trajectory/state.arrows", "physics@half-step/trajectory/state.arrows", "stills/side.png"):
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(b"0" * size)
    (folder / "physics" / "result.json").write_text(f'{{"ok": true, "started": "{started}"}}')
    run.keep(key_of(run), "lint", LintReport(rules=1))
    return folder


def job(run, number, state="failed", stage="physics", variant=""):
    spec = Spec(
        job=f"{stage}-{number}-0000000{number}", run=str(run.folder), stage=stage, variant=variant, key=key_of(run), still_s=1,
        memory_mb=1, output_mb=1, file_mb=1, disk_mb=1, created=time.time(),
    )  # fmt: skip
    made = Job.create(run, spec)
    (made.out / "state.arrows").write_bytes(b"0" * 100_000)
    made.log.write_text("said")
    made.scratch.rmdir()  # its supervisor does that at the end
    made.write(JobStatus(job=spec.job, stage=stage, key=spec.key.key, state=state))
    return made


def test_what_is_earlier_goes_and_what_stands_or_was_accepted_stays(make):
    run = make("one = 1")
    accepted = recorded(run)
    run.log("stamp", "accept", key=key_of(run).key, stamp_sha256="0")
    run.program.write_text("two = 2")
    earlier = recorded(run)
    run.program.write_text("three = 3")
    now = recorded(run)
    first, last = job(run, 1), job(run, 2)
    told = status(str(run.folder)).disk
    assert told.total_mb > 2.7 and "`worldwright gc` frees 1.0" in told.text()
    said = disk.free(run, key_of(run), dry=True)
    assert (earlier / "physics").is_dir() and said.freed_mb == pytest.approx(1.0, abs=0.01) == told.freeable_mb
    done = CliRunner().invoke(freeing.command, [str(run.folder)])
    assert done.exit_code == 0 and "freed 1.0 MB" in done.output
    assert sorted(path.name for path in earlier.iterdir()) == ["key.json", "lint.json", "source"]
    assert (earlier / "source" / "simulation.py").read_text() == "two = 2"
    for folder in (accepted, now):
        assert {"physics", "physics@half-step", "stills"} <= {path.name for path in folder.iterdir()}
    assert not first.out.exists() and first.log.read_text() == "said" and first.read().state == "failed"
    assert (last.out / "state.arrows").is_file()
    assert not disk.free(run, key_of(run), dry=False).removed


def test_the_recording_that_may_be_taken_over_stays_until_there_is_another(make):
    run = make("one = 1")
    old = recorded(run, started="2026-01-01")
    run.program.write_text("two = 2")
    newer = recorded(run, started="2026-01-02")
    run.program.write_text("three = 3")
    disk.free(run, key_of(run), dry=False)
    assert (newer / "physics").is_dir() and not (old / "physics").exists()


def test_nothing_goes_while_a_job_is_under_way(make):
    run = make("one = 1")
    old = recorded(run)
    run.program.write_text("two = 2")
    recorded(run)
    running = job(run, 1, state="running")
    with (running.folder / "lock").open("wb") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        with pytest.raises(GateError, match="under way"):
            disk.free(run, key_of(run), dry=False)
    assert (old / "physics").is_dir()
    disk.free(run, key_of(run), dry=False)
    assert not (old / "physics").exists()


def test_a_world_accepted_elsewhere_and_links_are_left_alone(make, tmp_path):
    run = make("one = 1")
    old = recorded(run)
    run.program.write_text("two = 2")
    recorded(run)
    (run.accepted / "x").mkdir(parents=True)
    (run.accepted / "stamp.json").write_text("{}")
    assert not disk.free(run, key_of(run), dry=False).removed
    (run.accepted / "stamp.json").unlink()
    elsewhere = tmp_path / "elsewhere"
    elsewhere.mkdir()
    (old / "video").symlink_to(elsewhere)
    disk.free(run, key_of(run), dry=False)
    assert elsewhere.is_dir() and (old / "video").is_symlink()


def test_traced_frames_and_the_newest_job_of_each_trial_stay(make):
    run = make("one = 1")
    recorded(run)
    first, last = job(run, 1, stage="final"), job(run, 2, stage="final")
    (first.folder / "frames" / "film").mkdir(parents=True)
    (first.folder / "frames" / "film" / "0.exr").write_bytes(b"0")
    trial, plain = job(run, 3, variant="half-step"), job(run, 4)
    disk.free(run, key_of(run), dry=False)
    assert (first.folder / "frames" / "film" / "0.exr").is_file() and not first.out.exists()
    assert all((one.out / "state.arrows").is_file() for one in (last, trial, plain))


def test_what_any_stamp_rests_on_stays_and_so_does_what_may_be_taken_over(make):
    run = make("one = 1")
    earlier = recorded(run)
    (run.folder / "earlier" / "abc").mkdir(parents=True)
    stamp = run.folder / "earlier" / "abc" / "stamp.json"
    stamp.write_text(f'{{"predicate": {{"source": {{"key": "{key_of(run).key}"}}}}}}')
    run.log("stamp", "accept", key="0" * 16, stamp_sha256="0")
    run.program.write_text("two = 2")
    other = run.evidence_key("1" * 64)
    run.keep(other, "lint", LintReport(rules=1))
    (run.evidence(other) / "physics").mkdir()
    recorded(run)
    disk.free(run, key_of(run), dry=False)
    assert (earlier / "physics").is_dir() and (run.evidence(other) / "physics").is_dir()
    stamp.write_text("torn")
    run.program.write_text("three = 3")
    assert not disk.free(run, key_of(run), dry=False).removed


@pytest.mark.parametrize("name", ["key.json", "physics/result.json", "video/result.json"])
@pytest.mark.parametrize("content", ["torn", "[]", None])
def test_a_key_of_which_a_report_cannot_be_read_stays_whole(make, name, content):
    run = make("one = 1")
    old = recorded(run)
    (old / "video").mkdir()
    run.program.write_text("two = 2")
    recorded(run)
    if content is None:
        (old / name).unlink(missing_ok=True)
        (old / name).mkdir()
    else:
        (old / name).write_text(content)
    assert not disk.free(run, key_of(run), dry=False).removed and (old / "physics" / "trajectory").is_dir()


def test_a_damaged_version_and_a_key_that_never_said_what_it_is_keep_nothing(make):
    run = make("one = 1")
    old = recorded(run)
    run.program.write_text("two = 2")
    unnamed = recorded(run)
    run.program.write_text("three = 3")
    recorded(run)
    (unnamed / "key.json").unlink()
    stamp = run.folder / "earlier" / "damaged-20260101-000000-000000" / "stamp.json"
    stamp.parent.mkdir(parents=True)
    stamp.write_text("torn")
    disk.free(run, key_of(run), dry=False)
    assert not (old / "physics").exists() and not (unnamed / "physics").exists()


def test_what_a_killed_job_left_is_ended_and_goes(make):
    run = make("one = 1")
    recorded(run)
    killed, traced = job(run, 1, state="running"), job(run, 2, state="running", stage="final")
    for one in (killed, traced):
        one.scratch.mkdir()
        (one.scratch / "half.bin").write_bytes(b"0" * 50_000)
    (traced.out / "frames" / "film").mkdir(parents=True)
    (traced.out / "frames" / "film" / "0.exr").write_bytes(b"0" * 10)
    token = family.new_token()
    spec = killed.spec.model_copy(update={"token": token})
    write_json(killed.folder / "spec.json", spec.model_dump(mode="json"))
    marked = [resource.RLIMIT_MSGQUEUE, family.mark(token)]
    with subprocess.Popen(["sleep", "600"], preexec_fn=lambda: resource.setrlimit(*marked)) as orphan:  # noqa: PLW1509
        said = disk.free(run, key_of(run), dry=True)
        assert orphan.poll() is None and killed.scratch.exists() and said.freed_mb == pytest.approx(0.3, abs=0.001)
        freed = disk.free(run, key_of(run), dry=False)
        assert orphan.wait(timeout=60) == -9
    assert freed.freed_mb == pytest.approx(said.freed_mb, abs=0.001)
    assert not any(path.exists() for one in (killed, traced) for path in (one.scratch, one.out))
    assert (traced.folder / "frames" / "film" / "0.exr").is_file() and killed.log.read_text() == "said"


def test_what_a_killed_job_of_a_rehearsal_left_is_ended_before_it_goes(make):
    run, copy = make("one = 1"), make("one = 1", name="world/rehearsal")
    copy.journal.unlink()
    copy.log("rehearsal", "rehearse", of="0", files=[])
    killed = job(copy, 1, state="running")
    killed.scratch.mkdir()
    token = family.new_token()
    write_json(killed.folder / "spec.json", killed.spec.model_copy(update={"token": token}).model_dump(mode="json"))
    marked = [resource.RLIMIT_MSGQUEUE, family.mark(token)]
    with subprocess.Popen(["sleep", "600"], preexec_fn=lambda: resource.setrlimit(*marked)) as orphan:  # noqa: PLW1509
        try:
            assert disk.free(run, key_of(run), dry=False).removed == ("rehearsal",)
            assert orphan.wait(timeout=60) == -9
        finally:
            orphan.kill()
    assert not copy.folder.exists()


def test_without_a_program_nothing_is_called_earlier(make):
    run = make("one = 1")
    recorded(run)
    run.program.write_text("two = 2")
    recorded(run)
    first, _ = job(run, 1), job(run, 2)
    (run.folder / f"{disk.GOING}0").mkdir()
    run.program.unlink()
    done = CliRunner().invoke(freeing.command, [str(run.folder)])
    assert done.exit_code == 0 and not (run.folder / f"{disk.GOING}0").exists()
    assert len(list((run.folder / "evidence").glob("*/physics"))) == 2 and first.out.is_dir()


def test_a_removal_that_is_killed_leaves_no_part_under_its_name_and_is_finished_later(make, monkeypatch):
    run = make("one = 1")
    old = recorded(run)
    run.program.write_text("two = 2")
    recorded(run)

    def killed(path):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(disk.shutil, "rmtree", killed)
        with pytest.raises(KeyboardInterrupt):
            disk.free(run, key_of(run), dry=False)
    assert len([path for path in old.iterdir() if path.name.startswith(disk.GOING)]) == 1
    disk.free(run, key_of(run), dry=False)
    assert sorted(path.name for path in old.iterdir()) == ["key.json", "lint.json", "source"]


def test_nothing_behind_a_link_is_removed(make, tmp_path):
    run = make("one = 1")
    recorded(run)
    run.program.write_text("two = 2")
    recorded(run)
    evidence, elsewhere = run.folder / "evidence", tmp_path / "papers"
    evidence.rename(elsewhere)
    evidence.symlink_to(elsewhere)
    before = sorted(elsewhere.rglob("*"))
    assert disk.used(run, key_of(run)).freeable_mb == 0
    with pytest.raises(GateError, match="evidence is a link") as refused:
        disk.free(run, key_of(run), dry=False)
    assert refused.value.place == str(evidence) and sorted(elsewhere.rglob("*")) == before
    evidence.unlink()
    elsewhere.rename(evidence)
    assert disk.free(run, key_of(run), dry=False).removed


def test_what_an_ended_job_was_given_stays_where_its_folder_is_a_link(make, tmp_path):
    run = make("one = 1")
    first, _ = job(run, 1), job(run, 2)
    (tmp_path / "world.mjz").write_bytes(b"mine")
    first.inputs.rename(tmp_path / "given")
    first.inputs.symlink_to(tmp_path)
    with pytest.raises(GateError, match="inputs is a link"):
        disk.free(run, key_of(run), dry=False)
    assert (tmp_path / "world.mjz").read_bytes() == b"mine"
