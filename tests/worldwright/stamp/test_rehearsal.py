"""A rehearsal measures a world before its plan is approved, tells all of it in one call, and leaves nothing that could be stamped."""

import errno
import hashlib
import shutil
import time
from collections import Counter
from pathlib import Path

import pytest
from click.testing import CliRunner

from worldwright import cli, freeing, rehearsing
from worldwright.model import call_time
from worldwright.model.errors import GateError, NotFoundError
from worldwright.model.evidence import rehearsed
from worldwright.model.evidence.run import Run
from worldwright.model.storage import StorageError
from worldwright.stage import tools as stage
from worldwright.stamp import rehearsal, rehearsal_copy
from worldwright.stamp import tools as stamp
from worldwright.stamp.halts import WrongError


def to_the_end(folder, go_on=False):
    """Call as an agent does, until it is no longer running."""
    for _ in range(40):
        told = rehearsing.rehearse(str(folder), timeout_s=30, go_on=go_on)
        if told.state != "running":
            return told
    raise AssertionError(told.text())


def own_files(folder: Path) -> dict[str, str]:
    """Hash by path of all that is the run's own."""
    return {
        path.relative_to(folder).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()
        for path in folder.rglob("*")
        if path.is_file() and "rehearsal" not in path.relative_to(folder).parts
    }


def journal(folder) -> Counter:
    return Counter((e.get("action"), e.get("stage", "")) for e in Run(folder / "rehearsal").entries())


def changed(folder, *changes):
    text = (folder / "plan.md").read_text(encoding="utf-8")
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    (folder / "plan.md").write_text(text, encoding="utf-8")


@pytest.mark.gl
@pytest.mark.slow
def test_a_plan_alone_is_measured_and_drawn_and_nothing_of_it_can_be_stamped(fresh):
    before = own_files(fresh)
    first = rehearsing.rehearse(str(fresh), timeout_s=0.01)
    assert first.state == "running" and first.next_move == f"worldwright stage rehearse {fresh}"
    told = to_the_end(fresh)
    assert (told.state, told.ok, told.program) == ("holds", True, "drafted"), told.text()
    falls, looks = told.objectives
    (measured,) = falls.expectations
    assert (falls.status, looks.status) == ("proved", "visual_only")
    assert measured.margin > 0 and measured.measured > 0.3
    assert told.storyboard and all(Path(path).is_file() for path in told.storyboard)
    assert told.cpu_s > 0 and told.next_move == f"worldwright go {fresh}"
    assert "nothing of it is evidence" in told.text()
    assert own_files(fresh) == before and {path.name for path in fresh.iterdir()} == {"plan.md", "rehearsal"}
    done = journal(fresh)
    assert all(done[what] == 1 for what in (("rehearse", ""), ("draft", ""), ("scan", ""), ("expect", "")))
    assert done["stage", "physics"] == done["stage", "storyboard"] == 1
    again = rehearsing.rehearse(str(fresh))
    assert (again.state, again.objectives, again.storyboard) == ("holds", told.objectives, told.storyboard)
    assert journal(fresh) == done

    # The run has proved nothing by it, and the rehearsal cannot be made one.
    assert stamp.status(str(fresh)).state == "open" and not stamp.status(str(fresh)).key
    for refused in (fresh, fresh / "rehearsal"):
        with pytest.raises(GateError) as no:
            stamp.accept(str(refused))
        assert refused == fresh or "this is a rehearsal" in no.value.cause
    with pytest.raises(GateError, match="this is a rehearsal"):
        stamp.approve(str(fresh / "rehearsal"), by="tester")
    with pytest.raises(GateError, match="rehearsal already"):
        rehearsing.rehearse(str(fresh / "rehearsal"))
    # Even its very bytes, laid where the run's evidence is, are nobody's: the journal of the run vouches for none of them.
    for path in (fresh / "rehearsal").iterdir():
        if path.name in ("plan.md", "simulation.py"):
            shutil.copy(path, fresh)
    shutil.copytree(fresh / "rehearsal/evidence", fresh / "evidence")
    with pytest.raises(GateError, match="no line of the journal vouches for"):
        stamp.accept(str(fresh))
    shutil.rmtree(fresh / "evidence")
    stamp.approve(str(fresh), by="tester")
    found = {step.name: step.status for step in stamp.status(str(fresh)).steps}
    assert found["approve"] == "holds" and {found[n] for n in ("lint", "physics", "scan", "expect")} == {"missing"}
    with pytest.raises(GateError, match="nothing is left to rehearse"):
        rehearsing.rehearse(str(fresh))


@pytest.mark.slow
def test_all_that_is_wrong_is_told_in_one_call_what_to_mend_first_in_front(fresh):
    changed(
        fresh,
        ("- falls: {body: ball, min_m: 0.3}", "- falls: {body: ball, min_m: 3.0}"),
        ("masses.ball]", "masses.bail]"),
    )
    told = to_the_end(fresh, go_on=True)
    steps = [found.step for found in told.findings if found.blocks]
    assert told.state == "stopped" and steps[0] == "check" and steps[-1] == "expect", told.text()
    assert len(set(steps)) > 1, "one call goes on after the first"
    assert steps == sorted(steps, key=["check", "place", "draft", "lint", "physics", "scan", "expect"].index)
    assert told.objectives[0].status == "refuted" and told.objectives[0].expectations[0].margin < 0
    blocks = [found.blocks for found in told.findings]
    assert blocks == sorted(blocks, reverse=True), "remarks come last"
    assert str(fresh / "plan.md") in told.next_move and "rehearsal/" not in "".join(f.what for f in told.findings)


@pytest.mark.slow
def test_a_changed_mass_is_rehearsed_again_and_the_earlier_recording_goes(fresh):
    to_the_end(fresh)
    changed(fresh, ("ball: 0.2", "ball: 0.5"))
    told = to_the_end(fresh)
    assert told.ok, told.text()
    assert "0.5" in (fresh / "rehearsal/simulation.py").read_text(encoding="utf-8")
    changed(fresh, ("ball: 0.5", "ball: 0.6"))
    to_the_end(fresh)
    recorded = list((fresh / "rehearsal/evidence").glob("*/physics"))
    assert len(recorded) == 2, "one that may be taken over, and the present one"


@pytest.mark.parametrize(
    ("found", "go_on", "simulated"),
    [
        ("simulation.py:9: error WM151 planned_size_differs: ball measures 0.2 m", False, False),
        ("plan.md:9: error WP124 unknown_inferred: it leads to nothing", False, False),
        ("simulation.py:9: error WM151 planned_size_differs: ball measures 0.2 m", True, True),
        ("simulation.py:9: error WL104 number: it is of nobody", False, True),
        ("simulation.py:9: error WM101 no_world: the time was up", False, True),
    ],
)
def test_what_lint_finds_wrong_in_plan_or_model_is_not_simulated_unless_asked(
    fresh, monkeypatch, found, go_on, simulated
):
    def lint(self):
        raise WrongError((found, self.patch()))

    def physics(self):
        ran.append(self)
        raise WrongError(("nothing here runs", "run it elsewhere"))

    ran = []
    monkeypatch.setattr(rehearsal.Rehearsal, "lint", lint)
    monkeypatch.setattr(rehearsal.Rehearsal, "physics", physics)
    told = rehearsing.rehearse(str(fresh), go_on=go_on)
    assert bool(ran) == simulated and told.state == "stopped" and any(found == one.what for one in told.findings)
    assert (f"worldwright stage rehearse {fresh} --go-on" in told.text()) != simulated


PROGRAM = """
from near import DROP
from worldkit import program, scene

def build():
    spec = scene.new("ball", time_step=0.002)
    body = spec.worldbody.add_body(name="ball", pos=(0, 0, DROP))
    body.add_freejoint()
    body.add_geom(size=(0.05, 0, 0), mass=0.2)
    return spec

program.main(build, duration=0.5)
"""


@pytest.mark.slow
def test_an_authors_program_is_rehearsed_as_it_stands_with_what_lies_beside_it(fresh):
    (fresh / "simulation.py").write_text(PROGRAM, encoding="utf-8")
    (fresh / "near.py").write_text("DROP = 1.0\n", encoding="utf-8")
    before = own_files(fresh)
    told = to_the_end(fresh, go_on=True)
    assert told.program == "its author's" and own_files(fresh) == before
    assert (fresh / "rehearsal/simulation.py").read_text(encoding="utf-8") == PROGRAM
    lint = [found for found in told.findings if found.step == "lint" and found.blocks]
    assert lint, "the world is not the planned one, which lint says"
    assert told.objectives[0].status == "proved", "and what was measured is told all the same"
    (fresh / "simulation.py").unlink()
    (fresh / "near.py").unlink()
    assert to_the_end(fresh).program == "drafted" and not (fresh / "rehearsal/near.py").exists()


def test_what_cannot_be_read_or_is_not_there_is_told(fresh, tmp_path):
    (fresh / "plan.md").write_text("# no plan\n", encoding="utf-8")
    told = rehearsing.rehearse(str(fresh))
    assert told.state == "stopped" and {found.step for found in told.findings} == {"check"} and not told.storyboard
    with pytest.raises(NotFoundError):
        rehearsing.rehearse(str(tmp_path / "nowhere"))


def test_findings_speak_of_the_authors_file_and_its_lines(planned, tmp_path):
    run = Run(shutil.copytree(planned, tmp_path / "ball"))
    copy = rehearsal.lay_out(run)
    text = copy.plan.read_text(encoding="utf-8")
    copy.plan.write_text(text.replace("## objectives", "added\nadded\n\n## objectives"), encoding="utf-8")
    walk = rehearsal.Rehearsal(run, copy, timeout_s=1, progress=lambda *_: None)
    line = next(
        n for n, said in enumerate(copy.plan.read_text(encoding="utf-8").splitlines(), 1) if said == "## topology"
    )
    own = run.plan.read_text(encoding="utf-8").splitlines().index("## topology") + 1
    assert own == line - 3
    assert walk.told_of_original(f"{copy.plan}:{line}: error") == f"{run.plan}:{own}: error"
    assert walk.told_of_original(f"plan.md:{line}: error") == f"plan.md:{own}: error"
    assert walk.told_of_original(f"{run.plan}:{own}: error") == f"{run.plan}:{own}: error"


def test_gc_removes_a_rehearsal_also_of_a_run_without_a_program(fresh):
    rehearsal.lay_out(Run(fresh))
    before = own_files(fresh)
    done = CliRunner().invoke(freeing.command, [str(fresh)])
    assert done.exit_code == 0 and "- rehearsal" in done.output
    assert not (fresh / "rehearsal").exists() and own_files(fresh) == before


def test_physics_without_approval_is_for_rehearsals_alone(fresh):
    (fresh / "simulation.py").write_text("one = 1", encoding="utf-8")
    with pytest.raises(GateError, match="needs an approval"):
        stage.start(str(fresh))
    copy = rehearsal.lay_out(Run(fresh))
    begun = stage.start(str(copy.folder))
    assert begun.stage == "physics" and not begun.cached
    stage.cancel(str(copy.folder), begun.job)
    assert not Run(fresh).journal.exists() and not any(Run(fresh).jobs.iterdir())


@pytest.mark.gl
@pytest.mark.slow
def test_a_sheet_of_what_a_plan_sculpts_needs_no_approval(fresh):
    (fresh / "sculpt").mkdir()
    (fresh / "sculpt/egg.py").write_text("from worldkit import sculpt\n\negg = sculpt.sphere(0.05)\n", encoding="utf-8")
    assert stage.sheet(str(fresh / "sculpt/egg.py")).pictures


def test_the_command_answers(fresh):
    (fresh / "plan.md").write_text("# no plan\n", encoding="utf-8")
    done = CliRunner().invoke(cli.main, ["stage", "rehearse", str(fresh)])
    assert done.exit_code == 1 and "rehearsal stopped" in done.output and "check" in done.output


@pytest.mark.parametrize("named", [["../../outside/victim"], ["/absolute"], ["link/victim"], ["journal.jsonl"], 3, [3]])
def test_nothing_outside_is_removed_by_what_a_rehearsal_says_of_itself(fresh, tmp_path, named):
    victim = tmp_path / "outside/victim"
    victim.parent.mkdir()
    victim.write_text("mine", encoding="utf-8")
    copy = rehearsal.lay_out(Run(fresh))
    (copy.folder / "link").symlink_to(victim.parent)
    copy.log("anybody", "rehearse", of="0", files=[str(victim)] if named == ["/absolute"] else named)
    with pytest.raises(GateError, match="nothing was removed") as no:
        rehearsing.rehearse(str(fresh))
    assert victim.read_text(encoding="utf-8") == "mine" and "worldwright gc" in no.value.next_move
    assert CliRunner().invoke(freeing.command, [str(fresh)]).exit_code == 0 and victim.is_file()
    rehearsal.lay_out(Run(fresh))


@pytest.mark.parametrize("kind", ["folder", "file", "link", "broken link", "linked rehearsal", "linked journal"])
def test_what_is_no_rehearsal_is_neither_used_nor_freed(fresh, tmp_path, kind):
    own, elsewhere = fresh / "rehearsal", tmp_path / "elsewhere"
    if kind in ("linked rehearsal", "linked journal"):
        rehearsal.lay_out(Run(fresh))
        moved = own if kind == "linked rehearsal" else own / "journal.jsonl"
        moved.rename(elsewhere)
        moved.symlink_to(elsewhere)
    elif kind == "folder":
        own.mkdir()
        (own / "notes.md").write_text("mine", encoding="utf-8")
    elif kind == "file":
        own.write_text("mine", encoding="utf-8")
    else:
        if kind == "link":
            elsewhere.mkdir()
        own.symlink_to(elsewhere)

    def tree():
        return sorted((str(p), p.read_bytes() if p.is_file() else b"") for p in tmp_path.rglob("*") if p.name != "jobs")

    before = tree()
    with pytest.raises(GateError, match="no rehearsal"):
        rehearsing.rehearse(str(fresh))
    done = CliRunner().invoke(freeing.command, [str(fresh)])
    assert done.exit_code == 0 and "freed 0.0 MB" in done.output and tree() == before


@pytest.mark.parametrize("method", ["replace", "unlink"])
def test_a_copy_that_was_not_laid_out_to_its_end_is_not_gone_on_with(fresh, monkeypatch, method):
    copy = rehearsal.lay_out(Run(fresh))
    first = copy.plan.read_bytes()
    changed(fresh, ("ball: 0.2", "ball: 0.5"))

    def killed(*_, **__):
        raise KeyboardInterrupt

    with monkeypatch.context() as patched:
        patched.setattr(Path, method, killed)
        with pytest.raises(KeyboardInterrupt):
            rehearsal.lay_out(Run(fresh))
    rehearsal.lay_out(Run(fresh))
    assert copy.plan.read_bytes() == (fresh / "plan.md").read_bytes() != first
    copy.plan.unlink()
    rehearsal.lay_out(Run(fresh))
    assert copy.plan.is_file()


def test_a_first_call_that_was_killed_at_its_first_line_is_begun_again(fresh):
    (fresh / "rehearsal").mkdir()
    (fresh / "rehearsal/journal.jsonl").write_text('{"actor": "rehear', encoding="utf-8")
    assert rehearsal.lay_out(Run(fresh)).plan.is_file()


def test_a_full_disk_is_told(fresh, monkeypatch):
    def full(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    with monkeypatch.context() as patched:
        patched.setattr(Path, "replace", full)
        with pytest.raises(StorageError) as no:
            rehearsing.rehearse(str(fresh))
    assert no.value.code == "disk_full"


def test_what_was_not_measured_does_not_hold(fresh, monkeypatch):
    monkeypatch.setattr(rehearsal.Rehearsal, "actions", lambda self: iter(()))
    told = rehearsing.rehearse(str(fresh))
    assert told.state == "stopped" and "nothing was measured" in told.text()


def test_two_calls_do_not_mix_and_a_plan_changed_meanwhile_is_not_answered_for(fresh, monkeypatch):
    copy = rehearsal.lay_out(Run(fresh))
    before = own_files(copy.folder)
    changed(fresh, ("ball: 0.2", "ball: 0.5"))
    with rehearsed.alone(copy.folder) as nobody_else:
        assert nobody_else
        told = rehearsing.rehearse(str(fresh), timeout_s=0.01)
        assert told.state == "running" and "another call" in told.text() and own_files(copy.folder) == before
        done = CliRunner().invoke(freeing.command, [str(fresh)])
        assert done.exit_code == 2 and "being rehearsed" in done.output and copy.plan.is_file()

    def actions(self):
        changed(fresh, ("ball: 0.5", "ball: 0.6"))
        yield "expect", lambda: "all of it"

    monkeypatch.setattr(rehearsal.Rehearsal, "actions", actions)
    told = rehearsing.rehearse(str(fresh))
    assert told.state == "running" and "changed meanwhile" in told.text() and "stage rehearse" in told.next_move


def test_lint_is_silent_on_what_check_has_said_and_on_nothing_else(fresh, monkeypatch):
    def says(*texts):
        def action():
            raise WrongError(*((text, "edit") for text in texts))

        return action

    def actions(self):
        yield "check", says(f"{fresh}/plan.md:3: error WP101 one: first")
        yield (
            "lint",
            says("rehearsal/plan.md:4: error WP101 one: first", "rehearsal/plan.md:9: error WP102 two: second"),
        )

    monkeypatch.setattr(rehearsal.Rehearsal, "actions", actions)
    said = [(found.step, found.what.split(": ")[-1]) for found in rehearsing.rehearse(str(fresh)).findings]
    assert said == [("check", "first"), ("lint", "second")]


def test_only_what_the_author_wrote_is_told_under_the_run(fresh):
    run, copy = Run(fresh), rehearsal.lay_out(Run(fresh))

    def told(text):
        return rehearsal.Rehearsal(run, copy, timeout_s=1, progress=lambda *_: None).told_of_original(text)

    assert told(f"edit {copy.plan}") == f"edit {run.plan}"
    assert told(f"worldwright go {copy.folder}") == f"worldwright go {fresh}"
    for drafted in ("simulation.py:3", "evidence/0/physics", "jobs/physics-1", "plan.md-old"):
        assert told(f"{copy.folder}/{drafted}: wrong") == f"{copy.folder}/{drafted}: wrong"
    run.program.write_text(PROGRAM, encoding="utf-8")
    (fresh / "near.py").write_text("DROP = 1.0\n", encoding="utf-8")
    rehearsal.lay_out(run)
    for own in ("simulation.py:3", "near.py:1"):
        assert told(f"{copy.folder}/{own}: wrong") == f"{fresh}/{own}: wrong"


def test_a_call_has_its_end_from_its_beginning(fresh, monkeypatch):
    given = []
    with monkeypatch.context() as patched, call_time.limited(call_time.SPARE_S + 5):
        patched.setattr(rehearsal, "rehearse", lambda run, timeout_s, *_: given.append(timeout_s))
        rehearsing.rehearse(str(fresh), timeout_s=1e6)
    assert 0 < given[0] <= 5

    laid = rehearsal.lay_out

    def slow(run):
        time.sleep(0.2)
        return laid(run)

    def actions(self):
        given.append(self.deadline)
        return iter(())

    monkeypatch.setattr(rehearsal, "lay_out", slow)
    monkeypatch.setattr(rehearsal.Rehearsal, "actions", actions)
    before = time.monotonic()
    rehearsal.rehearse(Run(fresh), 0.1, lambda *_: None)
    assert given[1] - before >= 0.2, "what is left is none, not the whole again"


def test_git_takes_no_rehearsal_of_an_example():
    ignored = (Path(__file__).parents[3] / ".gitignore").read_text(encoding="utf-8").splitlines()
    assert f"examples/*/{rehearsed.FOLDER}/" in ignored


def test_the_laws_that_a_plan_names_come_along(tmp_path):
    plan = Path(__file__).parents[1] / "world/rubber-cord.md"
    run = Run(tmp_path / "cord")
    (run.folder / "laws").mkdir(parents=True)
    shutil.copy(plan, run.plan)
    (run.folder / "laws/rubber.py").write_text("import near\n\n\nclass Rubber: ...\n", encoding="utf-8")
    (run.folder / "near.py").write_text("LONG = 0.4\n", encoding="utf-8")
    (run.folder / "laws/other.py").write_text("UNNAMED = 1\n", encoding="utf-8")
    copy = rehearsal.lay_out(run)
    laid = {path.relative_to(copy.folder).as_posix() for path in copy.folder.rglob("*.py")}
    assert laid == {"laws/rubber.py", "near.py"}
    (run.folder / "laws/rubber.py").write_text("class Rubber: LONG = 1\n", encoding="utf-8")
    assert not rehearsal_copy.stands(run, copy), "another law is another rehearsal"
