"""`go`: how far one call brings a run, that it tells everything wrong together, and that nothing is done twice."""

import shutil
import time
from collections import Counter
from pathlib import Path
from types import SimpleNamespace

import pytest
from click.testing import CliRunner

from worldwright import cli
from worldwright.draft.writing import write_program
from worldwright.lint.compiled import fetch
from worldwright.model import call_time
from worldwright.model.errors import GateError, WorldwrightError
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run
from worldwright.model.plan.plan_text import read_plan
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stage.job import Job
from worldwright.stamp import at_work, going, smallest_seen, uncaused
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State


def journal(folder) -> Counter:
    """How often each thing was done."""
    return Counter((e.get("action"), e.get("stage", "")) for e in Run(folder).entries())


def to_the_end(folder, **options):
    """Call as an agent does, until it is no longer running."""
    for _ in range(40):
        gone = stamp.go(str(folder), timeout_s=30, **options)
        if gone.state != "running":
            return gone
    raise AssertionError(gone.text())


def to_the_storyboard(folder, **options):
    """The same, and until the storyboard is there, which is drawn beside the call: that does not wait for it beyond its time."""
    for _ in range(10):
        gone = to_the_end(folder, **options)
        if gone.storyboard:
            return gone
    raise AssertionError(gone.text())


def plan_of(folder, *changes):
    text = (folder / "plan.md").read_text(encoding="utf-8")
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    (folder / "plan.md").write_text(text, encoding="utf-8")
    return folder


def test_it_waits_for_a_persons_word_and_gives_none_itself(fresh):
    gone = stamp.go(str(fresh))
    assert (gone.state, gone.ok, gone.wrong) == ("waiting", True, ())
    assert set(gone.held) == {"check", "place"} and "worldwright stamp approve" in gone.next_move
    assert not (fresh / "simulation.py").exists() and not Run(fresh).entries().__next__().get("by")


def test_what_is_wrong_with_a_plan_is_told_together(fresh):
    plan_of(
        fresh, ("falls: {body: ball,", "falls: {body: bail,"), ("params: {bottom: 0.45}", "params: {bottom: -0.45}")
    )
    gone = stamp.go(str(fresh))
    assert gone.state == "stopped" and not gone.ok
    assert [wrong.step for wrong in gone.wrong] == ["check", "place"], gone.text()
    assert "bail" in gone.wrong[0].what and gone.next_move == gone.wrong[0].next_move


def test_a_plan_whose_written_poses_are_older_than_its_rows_is_neither_approved_nor_run(fresh):
    stamp.go(str(fresh))
    plan_of(fresh, ("params: {bottom: 0.45}", "params: {bottom: 0.55}"))
    with pytest.raises(GateError) as refused:
        stamp.approve(str(fresh), by="tester")
    assert "0.1 m" in str(refused.value) and "place resolve" in str(refused.value), refused.value
    assert stamp.go(str(fresh)).state == "waiting", "before approval a walk writes them itself"
    stamp.approve(str(fresh), by="tester")


def test_an_approved_plan_with_old_poses_says_so_before_its_program_is_built(fresh, monkeypatch):
    stamp.go(str(fresh))
    plan_of(fresh, ("params: {bottom: 0.45}", "params: {bottom: 0.55}"))
    monkeypatch.setattr(going.Going, "approved", lambda self: True)
    gone = stamp.go(str(fresh))
    assert {wrong.step for wrong in gone.wrong} == {"place"} and "place resolve" in gone.next_move, gone.text()


class Long:
    """A physics that has as long to go as it is told."""

    stage, eta_s = "physics", 400.0

    def text(self):
        return "physics running, about 400 s left\n"


def test_a_long_wait_is_told_now_and_then_with_the_cheaper_choice_of_a_law(monkeypatch):
    clock, said = [0.0], []
    monkeypatch.setattr(at_work.time, "monotonic", lambda: clock[0])
    plan = read_plan(Path(__file__).parents[1] / "world/rubber-cord.md").plan
    waiting = at_work.Waiting(
        lambda *told: said.append((clock[0], *told)), SimpleNamespace(plan=plan, place="runs/cord")
    )
    for clock[0] in (0.0, 29.0, 30.0, 45.0, 61.0, 90.0, 125.0):
        assert 0 < waiting.within_s(Long(), 1e9) <= 30
    assert [at for at, *_ in said] == [30.0, 61.0, 125.0]
    assert (
        said[0][1:3] == ("physics", "waiting")
        and "fewer points" in said[0][3]
        and "stage cancel runs/cord" in said[0][3]
    )
    plain = SimpleNamespace(plan=None, place="runs/cord")
    assert at_work.line(Long(), plain) == "physics running, about 400 s left"


@pytest.mark.gl
@pytest.mark.slow
def test_one_call_after_another_brings_it_to_its_description_and_does_nothing_twice(fresh, monkeypatch):
    beside = []
    monkeypatch.setattr(scan, "begin_robust", lambda run: beside.append(len(journal(run.folder))) or "robust: beside")
    stamp.go(str(fresh))
    stamp.approve(str(fresh), by="tester")
    first = stamp.go(str(fresh), timeout_s=0.01)
    assert first.state == "running" and first.under_way and first.next_move.startswith("worldwright go")
    gone = to_the_end(fresh)
    assert gone.state == "waiting" and "stamp describe" in gone.next_move, gone.text()
    assert list(gone.held) == [
        "check", "place", "approve", "draft", "lint", "physics", "scan", "expect", "causes", "stills", "video",
    ]  # fmt: skip
    assert len(beside) == 1 and gone.robust == "beside" and "· robust  beside" in gone.text()
    assert gone.storyboard.endswith("storyboard") and "deepest penetration" in gone.held["physics"]
    done = journal(fresh)
    once = [("draft", ""), ("scan", ""), ("expect", ""), ("stage", "physics"), ("stage", "storyboard")]
    assert all(done[what] == 1 for what in (*once, ("stage", "stills"), ("stage", "video"))), done
    again = stamp.go(str(fresh))
    assert (again.state, again.held.keys()) == ("waiting", gone.held.keys()) and journal(fresh) == done


@pytest.mark.slow
def test_the_walk_ends_where_it_is_told_to(fresh, monkeypatch):
    stamp.approve(str(fresh), by="tester")
    gone = to_the_storyboard(fresh, until="expect")
    assert list(gone.held)[-1] == "expect", gone.text()
    assert not [job for job in (fresh / "jobs").iterdir() if job.name.startswith(("stills", "video"))]
    monkeypatch.setattr(scan, "smallest", lambda _: pytest.fail("the recording is read again"))
    assert (fresh / "film.py").is_file() and (Path(gone.moving) / "moving.mp4").stat().st_size > 1000
    assert [*Path(gone.moving).glob("*.jpg")] and f"look at {gone.moving}; judge" in gone.next_move
    assert "film.py marks CHANGE" in gone.next_move and "--show shots" in gone.next_move
    (fresh / "film.py").unlink()
    bare = stamp.go(str(fresh), until="expect")  # whoever took it away gets no other
    assert not (bare.moving or (fresh / "film.py").exists()) and bare.next_move.startswith("write ")
    assert "judge belief now" in gone.next_move and "Below 7" in gone.next_move
    assert "smallest" in gone.held["scan"] and stamp.go(str(fresh), until="expect").held["scan"] == gone.held["scan"]


def test_what_one_walk_keeps_another_may_drop_meanwhile(fresh, monkeypatch):
    class Dropped(dict):
        def __setitem__(self, *_):
            """Another thread clears it at once."""

    monkeypatch.setattr(smallest_seen, "_SMALLEST", Dropped())
    monkeypatch.setattr(scan, "smallest", lambda _: "ball 9 px")
    assert smallest_seen.smallest_seen(Run(fresh)) == "ball 9 px"


@pytest.mark.slow
def test_what_the_end_of_a_call_cut_is_not_wrong_but_under_way(fresh, monkeypatch):
    stamp.go(str(fresh))
    stamp.approve(str(fresh), by="tester")
    write_program(Run(fresh))
    job = stage.start(str(fresh), stage="bundle")
    while not job.ended:
        job = stage.wait(str(fresh), job=job.job)
    monkeypatch.setattr(fetch, "_KEPT", {})
    with call_time.limited(0.0):
        gone = stamp.go(str(fresh))
    assert (gone.state, gone.wrong) == ("running", ()), gone.text()
    assert gone.under_way[0].startswith("lint: it was not done within the 280 s that a call may take; call it again")
    assert not State(Run(fresh)).lint.value
    assert "lint" in stamp.go(str(fresh), until="lint").held


@pytest.mark.slow
def test_what_the_recording_refutes_is_told_at_once_together_and_nothing_is_filmed(fresh):
    claims = "- falls: {body: ball, min_m: 3.0}\n    - comes_to_rest: {body: ball, before_s: 1.0}"
    plan_of(fresh, ("- falls: {body: ball, min_m: 0.3}", claims), ("duration: 0.5", "duration: 1.1"))
    stamp.go(str(fresh))
    stamp.approve(str(fresh), by="tester")
    gone = to_the_storyboard(fresh)
    assert gone.state == "stopped"
    assert [wrong.step for wrong in gone.wrong] == ["scan", "expect"], gone.text()
    assert "failure_to_settle" in gone.wrong[0].what
    assert "falls" in gone.wrong[1].what and "comes_to_rest" in gone.wrong[1].what
    assert not {("stage", "stills"), ("stage", "video")} & set(journal(fresh))
    assert gone.wrong == to_the_end(fresh).wrong


@pytest.mark.slow
def test_an_effect_that_comes_without_its_cause_is_told_with_the_claims_and_nothing_is_filmed(fresh, monkeypatch):
    plan_of(fresh, ("The ball falls to the floor.", "The ball falls to the floor.\n  cause: ground"))
    stamp.go(str(fresh))
    stamp.approve(str(fresh), by="tester")
    gone = to_the_end(fresh)
    assert [wrong.step for wrong in gone.wrong] == ["expect"], gone.text()
    assert "WS321" in gone.wrong[0].what and "without ground, falls still holds" in gone.wrong[0].what
    assert not {("stage", "stills"), ("stage", "video"), ("scan", "causes")} & set(journal(fresh))
    made = {job.spec.variant for job in Job.all(Run(fresh)) if job.spec.variant}
    assert len(made) == 1 and gone.wrong == to_the_end(fresh).wrong
    assert {job.spec.variant for job in Job.all(Run(fresh)) if job.spec.variant} == made, "it is paid once"
    monkeypatch.setattr(uncaused, "WITHIN_S", 0.0)
    assert "expect" in stamp.go(str(fresh), until="expect").held, "a long physics waits for the whole audit"


FAILING = """
import time
from worldkit import program

def build():
    time.sleep(1)
    raise ValueError("no world")

program.main(build, duration=0.1)
"""


@pytest.mark.slow
def test_a_pass_that_failed_while_nobody_waited_is_told_once_and_then_tried_again(fresh):
    stamp.go(str(fresh))
    stamp.approve(str(fresh), by="tester")
    (fresh / "simulation.py").write_text(FAILING, encoding="utf-8")
    run = Run(fresh)
    run.keep(run.evidence_key(environment.current().sha256()), "lint", LintReport(rules=1))
    cut = CliRunner().invoke(cli.main, ["go", str(fresh), "--timeout-s", "0.01"])
    assert cut.exit_code == 1 and "running" in cut.output and f"worldwright go {fresh}" in cut.output, cut.output
    time.sleep(0.1)
    gone = to_the_end(fresh)
    assert gone.state == "stopped" and "no world" in gone.wrong[0].what, gone.text()
    assert len(list(run.jobs.glob("physics-*"))) == 1
    assert to_the_end(fresh).state == "stopped" and len(list(run.jobs.glob("physics-*"))) == 2


def test_the_command_tells_each_step_and_answers_no_while_a_decision_is_due(fresh):
    done = CliRunner().invoke(cli.main, ["go", str(fresh)])
    assert done.exit_code == 1 and "· approve" in done.output and "next: read" in done.output


def test_an_approved_plan_is_not_written_again(planned, tmp_path):
    shutil.copytree(planned, tmp_path / "run")
    stamp.approve(str(tmp_path / "run"), by="tester")
    before = (tmp_path / "run/plan.md").stat()
    assert "place" in stamp.go(str(tmp_path / "run"), timeout_s=0.01).held
    assert (tmp_path / "run/plan.md").stat().st_mtime_ns == before.st_mtime_ns


def test_no_pose_is_written_into_a_plan_that_still_stands_as_copied(fresh):
    plan_of(fresh, ("## topology\n", "## topology\n\n<!-- TO_CHANGE: where they stand -->\n"))
    before = (fresh / "plan.md").read_bytes()
    gone = stamp.go(str(fresh))
    assert [wrong.step for wrong in gone.wrong] == ["check"] and "WP133" in gone.wrong[0].what
    assert "place" in gone.held and (fresh / "plan.md").read_bytes() == before
    with pytest.raises(WorldwrightError, match="still as copied"):
        stamp.approve(str(fresh), by="tester")


def test_an_interrupted_walk_says_what_goes_on_and_how_to_end_it(fresh, monkeypatch):
    def stopped(walk):
        raise KeyboardInterrupt

    monkeypatch.setattr(going.Going, "go", stopped)
    jobs = [Job(fresh / "jobs" / name) for name in ("video-2", "physics-1")]
    at_work = {"video-2": True, "physics-1": False}
    monkeypatch.setattr(Job, "all", lambda run: jobs)
    monkeypatch.setattr(
        Job, "read", lambda job: SimpleNamespace(ended=not at_work[job.folder.name], text=lambda: "video running")
    )
    said = CliRunner().invoke(cli.main, ["go", str(fresh)])
    assert said.exit_code == 130 and f"worldwright stage cancel {fresh} --job video-2" in said.output
    assert "physics-1" not in said.output


def test_a_memory_limit_reaches_every_pass_by_tool_and_by_command(fresh, monkeypatch):
    asked = []

    def start(_, stage, memory_mb):
        asked.append((stage, memory_mb))
        raise GateError("enough", next_move="-")

    monkeypatch.setattr(stage, "start", start)
    monkeypatch.setattr(stage, "latest", lambda *_: None)
    monkeypatch.setattr(going.Going, "go", going.Going.physics)
    monkeypatch.setattr("worldwright.report.write", lambda run: run.folder)
    for call in (lambda: stamp.go(str(fresh), memory_mb=6000), lambda: stamp.go(str(fresh))):
        with pytest.raises(GateError):
            call()
    CliRunner().invoke(cli.main, ["go", str(fresh), "--memory-mb", "7000"])
    assert asked == [("physics", 6000), ("physics", 4096), ("physics", 7000)]


class Film:
    """A film that is drawn behind the audits."""

    stage, eta_s, ended = "video", 250.0, False

    def text(self):
        return "video running · job video-11 · 93.0 s · 12/65 frames, about 250 s left\n"


def test_audits_before_the_film_say_at_once_what_runs_and_how_far_and_again(fresh, monkeypatch):
    """After `expect` nothing was told while the audits repeated the physics and the film was drawn behind them."""
    clock, said, asked = [0.0], [], []

    def audit(name, *, timeout_s, progress, **_):
        asked.append(timeout_s)
        clock[0] += timeout_s
        progress(len(asked), 6, f"{len(asked)} of 6 repetitions")
        return SimpleNamespace(pending=("without-servo",) if len(asked) < 6 else ())

    monkeypatch.setattr(at_work.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr(scan, "scan", audit)
    monkeypatch.setattr(going.audited, "why_causes", lambda state: "forces")
    monkeypatch.setattr(stage, "latest", lambda run, name: Film() if name == "video" else None)
    walk = going.Going(Run(fresh), say=lambda *told: said.append((clock[0], *told)))
    assert "not" in walk.causes() and len(asked) == 6
    assert [at for at, *_ in said] == [0.0, 30.0, 60.0, 120.0]
    assert {told[:2] for _, *told in said for told in [tuple(told)]} == {("causes", "waiting")}
    assert "beside them: video running" in said[0][3] and "about 250 s left" in said[0][3]
    assert "audits running · 2 of 6 repetitions" in said[2][3]
