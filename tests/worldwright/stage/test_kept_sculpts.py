"""What is sculpted is made once, outside every pass; nobody but the file itself can say what it makes."""

import os
import time
import uuid

import pytest

from worldwright.lint import tools as lint
from worldwright.lint.compiled import planned
from worldwright.model import call_time
from worldwright.model.errors import CallOverError, JobError
from worldwright.model.evidence import environment
from worldwright.model.evidence.reports import LintReport
from worldwright.model.evidence.run import Run
from worldwright.model.plan.plan_text import read_plan
from worldwright.stage import confined, kept_sculpts, sculpting_step
from worldwright.stage import tools as stage

BOWL = """\
from shades import CLAY
from worldkit import sculpt

BOWL = (sculpt.sphere(0.2).shell(0.02) - sculpt.half_space((0, 0, -1), 0.0)) - sculpt.half_space((0, 0, 1), -0.09)
POT = sculpt.Part("pot", BOWL, look=CLAY, make={"cells": 32})
"""


@pytest.fixture
def run(tmp_path, sculpted_plan):
    """A run whose sculpture nobody else ever made."""
    folder = tmp_path / "bowl"
    (folder / "sculpt").mkdir(parents=True)
    (folder / "plan.md").write_text(sculpted_plan)
    (folder / "sculpt/bowl.py").write_text(BOWL + f"# {uuid.uuid4()}\n")
    (folder / "sculpt/shades.py").write_text('CLAY = "#b5653a"\n')
    return Run(folder)


def place(run):
    return kept_sculpts.place_of(kept_sculpts.needed(run.folder, "sculpt/bowl.py"))


def entries(run):
    return {path.name: path.stat().st_mtime_ns for path in place(run).glob("*.npz")}


@pytest.fixture
def draft():
    """Approves a run and drafts its program."""
    from worldwright.draft.writing import write_program
    from worldwright.stamp import tools as stamp

    def draft(run):
        stamp.approve(str(run.folder), by="tester")
        write_program(run)

    return draft


def test_it_is_made_once_for_lint_sheet_and_all_passes(run, finish, draft):
    plan = read_plan(run.plan).plan
    assert sculpting_step.prepare(plan) == 1
    assert sculpting_step.prepare(plan) == 0
    made = entries(run)
    assert len(made) == 1
    stage.sheet(str(run.folder / "sculpt/bowl.py"))
    draft(run)
    report = lint.check_program([run.program])
    assert [f.text() for f in report.findings if f.severity == "error"] == []
    for pass_name in ("bundle", "physics"):
        assert finish(run, stage=pass_name).state == "succeeded"
    own = kept_sculpts.of_files(run.program, [run.folder / "sculpt/bowl.py", run.folder / "sculpt/shades.py"])
    assert entries(run) == made and place(run) in own.places
    assert not own.own.exists()  # a process that had made anything would have left it there


def test_a_broken_entry_is_found_by_its_hash_and_made_anew(run):
    plan = read_plan(run.plan).plan
    sculpting_step.prepare(plan)
    (name,) = entries(run)
    good = (place(run) / name).read_bytes()
    (place(run) / name).write_bytes(good[:200] + b"poison" + good[206:])
    assert sculpting_step.prepare(plan) == 1
    assert (place(run) / name).read_bytes() == good
    (place(run) / name).unlink()
    assert sculpting_step.prepare(plan) == 1


@pytest.mark.parametrize(
    ("line", "code", "said", "where"),
    [
        ("raise ValueError('no clay')", "crashed", "no clay", ":7"),
        ("while True: pass", "timed_out", "more than 1 s of processor time", ""),
        ("try: raise OSError(28, 'No space')\nexcept OSError: raise ValueError('no clay')", "crashed", "no clay", ":8"),
        ("raise ValueError('no clay, said the last one: [Errno 28] No space')", "crashed", "no clay", ":7"),
    ],
)
def test_what_fails_does_so_once_for_exactly_these_sources(run, monkeypatch, line, code, said, where):
    file, plan = run.folder / "sculpt/bowl.py", read_plan(run.plan).plan
    file.write_text(file.read_text() + line + "\n")
    with monkeypatch.context() as short:
        if code == "timed_out":
            short.setattr(sculpting_step, "WALL_S", 1.0)
        first = refused(plan)
    assert (first.code, first.place) == (code, f"{file}{where}") and said in first.cause
    with monkeypatch.context() as idle:
        idle.setattr(sculpting_step.confined, "run", None)
        assert str(refused(plan)) == str(first)
        assert (told := planned.world(plan)).status == "failed" and said in told.message
    file.write_text(BOWL + f"# {uuid.uuid4()}\n")
    assert sculpting_step.prepare(plan) == 1


def test_the_end_of_a_call_tells_nothing_of_a_plan_or_its_file(run):
    file, plan = run.folder / "sculpt/bowl.py", read_plan(run.plan).plan
    file.write_text(file.read_text() + f"# {uuid.uuid4()}\n")
    with call_time.limited(0.0), pytest.raises(CallOverError):
        planned.world(plan)
    assert not (place(run) / sculpting_step.FAILED).exists()


def test_what_took_all_its_own_time_is_told_though_the_call_ended_too(run, monkeypatch):
    monkeypatch.setattr(sculpting_step.confined, "run", lambda *_, **__: confined.Confined("timed_out"))
    with call_time.limited(0.0):
        assert refused(read_plan(run.plan).plan).code == "timed_out"


@pytest.mark.parametrize(
    ("line", "code", "move"),
    [
        ("import os; os.kill(os.getpid(), 9)", "crashed", "correct it"),
        ("raise OSError(errno.ENOSPC, 'No space left on device', 'a file')", "disk_full", "disk space of this machine"),
        ("raise OSError(errno.EDQUOT, 'Disk quota exceeded')", "disk_full", "disk space of this machine"),
        ("import mmap; mmap.mmap(-1, 1 << 44)", "out_of_memory", "if it does neither, free memory of this machine"),
        ("raise OSError(errno.EAGAIN, 'No process')", "too_many_processes", "let it start fewer processes"),
    ],
)
def test_what_the_machine_did_or_may_have_done_is_not_noted_against_the_file(run, line, code, move):
    """A process or memory that is refused may be the machine's want, or the file's own that asks for too much: both are named."""
    file, plan = run.folder / "sculpt/bowl.py", read_plan(run.plan).plan
    file.write_text(file.read_text() + f"import errno\n{line}\n")
    said = refused(plan)
    assert said.code == code and move in said.next_move
    assert not (place(run) / sculpting_step.FAILED).exists()


def test_a_sheet_takes_back_that_a_file_cannot_be_made(run, monkeypatch):
    plan = read_plan(run.plan).plan
    with monkeypatch.context() as short:
        short.setattr(sculpting_step, "WALL_S", 0.0)
        refused(plan)
    stage.sheet(str(run.folder / "sculpt/bowl.py"))
    assert not (place(run) / sculpting_step.FAILED).exists()
    sculpting_step.prepare(plan)


def test_what_no_key_tells_is_not_made_ahead_twice(run, monkeypatch):
    """A paint that holds a running generator is made anew by whoever needs it, not by every look at the plan, too."""
    file, plan = run.folder / "sculpt/bowl.py", read_plan(run.plan).plan
    held = "HELD = (n for n in range(9))\n\ndef paint(points, _):\n    return points * 0 + 0.1 * (HELD is not None)\n"
    file.write_text(file.read_text().replace("POT = ", held + "\n\nPOT = ").replace("look=CLAY", "paint=paint"))
    assert sculpting_step.prepare(plan) == 0 and not entries(run)
    monkeypatch.setattr(sculpting_step.confined, "run", None)
    assert sculpting_step.prepare(plan) == 0


def test_what_is_too_much_to_be_kept_is_not_made_ahead_twice(run, monkeypatch):
    monkeypatch.setattr(kept_sculpts, "MOST_IN_PLACE", 10)
    plan = read_plan(run.plan).plan
    assert sculpting_step.prepare(plan) == 1 and not entries(run)
    monkeypatch.setattr(sculpting_step.confined, "run", None)
    assert sculpting_step.prepare(plan) == 0


def refused(plan):
    with pytest.raises(JobError) as failure:
        sculpting_step.prepare(plan)
    return failure.value


def test_who_cancels_ends_it_at_once_and_nothing_is_noted(run):
    file, plan = run.folder / "sculpt/bowl.py", read_plan(run.plan).plan
    good = file.read_text()
    file.write_text(good + "import time; time.sleep(600)\n")
    before = time.monotonic()
    assert sculpting_step.prepare(plan, lambda: True) == 0 and time.monotonic() - before < 60
    assert not (place(run) / sculpting_step.FAILED).exists()


def test_a_job_hears_while_it_sculpts(run, draft):
    file = run.folder / "sculpt/bowl.py"
    file.write_text(file.read_text() + "import time; time.sleep(600)\n")
    draft(run)
    run.keep(run.evidence_key(environment.current().sha256()), "lint", LintReport(rules=1))
    stage.start(str(run.folder), stage="bundle")
    time.sleep(2.0)
    assert stage.cancel(str(run.folder)).state == "cancelled"


def test_a_place_in_use_outlives_those_of_edits(monkeypatch, tmp_path):
    monkeypatch.setattr(kept_sculpts, "cache_folder", lambda: tmp_path)
    content = b"a shape"
    name = kept_sculpts.kept_shapes.name_of("0" * 24, content)

    def keep(files):
        one = kept_sculpts.Given((kept_sculpts.place_of(files),), kept_sculpts.place_of(files))
        scratch = tmp_path / "scratch" / uuid.uuid4().hex
        (scratch / "sculpt").mkdir(parents=True)
        (scratch / "sculpt" / name).write_bytes(content)
        assert one.keep(scratch) == (name,)
        return one

    plans = keep({"sculpt/bowl.py": b"the plan's"})
    entry = plans.own / name
    before = entry.stat().st_ino
    os.utime(plans.own, (1, 1))
    for edit in range(kept_sculpts.MOST_PLACES + 1):
        os.utime(keep({"simulation.py": b"%d" % edit}).own, (2 + edit, 2 + edit))
        plans.variables(tmp_path)
    assert entry.is_file() and len(list((tmp_path / "sculpts").iterdir())) == kept_sculpts.MOST_PLACES
    keep({"sculpt/bowl.py": b"the plan's"})
    assert entry.stat().st_ino == before  # a reader beside is not disturbed


def test_another_helper_makes_it_another_thing(run):
    before = place(run)
    (run.folder / "sculpt/shades.py").write_text('CLAY = "#ffffff"\n')
    assert place(run) != before


def test_a_program_can_write_into_no_place_and_leaves_something_in_its_own_alone(run):
    sculpting_step.prepare(read_plan(run.plan).plan)
    made = entries(run)
    program = run.folder / "simulation.py"
    program.write_text(
        "import os, pathlib\n"
        "from worldkit import kept_shapes\n"
        "for place in os.environ['WORLDKIT_SCULPT_GIVEN'].split(os.pathsep):\n"
        "    for path in pathlib.Path(place).glob('*.npz'):\n"
        "        key = path.name[:24]\n"
        "        kept_shapes.keep(key, {'poison': __import__('numpy').zeros(3)})\n"
        "        try:\n"
        "            path.write_bytes(b'poison')\n"
        "        except OSError:\n"
        "            print('refused')\n"
        f"# {uuid.uuid4()}\n"
    )
    files = [run.folder / "sculpt/bowl.py", run.folder / "sculpt/shades.py"]
    done = stage.run_confined([os.sys.executable, "-s", str(program)], program=program, reads=[program, *files])
    assert done.status == "ended" and "refused" in done.log, done.log
    assert entries(run) == made and len(done.sculpted) == 1
    own = kept_sculpts.of_files(program, files).own
    assert [path.name for path in own.glob("*.npz")] == list(done.sculpted) and own != place(run)


def test_a_process_may_read_what_each_file_that_sculpts_made_alone_and_no_other():
    files = {
        "simulation.py": b"import numbers_of, sculpt.bowl\n",
        "numbers_of.py": b"TABLE = 'table.csv'\n",
        "table.csv": b"sculpt",
        "sculpt/bowl.py": b"import shades\nMASK = 'mask.png'\n",
        "sculpt/shades.py": b"from worldkit import sculpt\n",
        "sculpt/mask.png": b"png",
    }
    own = kept_sculpts.place_of(files)
    bowl = kept_sculpts.place_of({name: files[name] for name in files if name.startswith("sculpt/")})
    shades = kept_sculpts.place_of({"sculpt/shades.py": files["sculpt/shades.py"]})
    assert kept_sculpts.given(files).places == (own, bowl, shades)
    plain = {name: content for name, content in files.items() if not name.startswith("sculpt/")}
    plain["simulation.py"] = b"import numbers_of\n"
    assert kept_sculpts.given(plain).places == (kept_sculpts.place_of(plain),)


def test_what_is_kept_has_a_limit_in_bytes_for_each_place_and_for_all(tmp_path, monkeypatch):
    monkeypatch.setattr(kept_sculpts, "cache_folder", lambda: tmp_path)
    monkeypatch.setattr(kept_sculpts, "MOST_IN_PLACE", 3_500)
    monkeypatch.setattr(kept_sculpts, "MOST_IN_ALL", 5_500)
    for place in range(2):
        for entry in range(5):
            path = tmp_path / "sculpts" / f"place{place}" / f"{entry}.npz"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(b"x" * 1_000)
            os.utime(path, (1_000 + 10 * place + entry,) * 2)
    # The place whose entries are older was used last: it is the other one that goes, and it goes whole.
    used = {f"place{place}": (5_000 - place,) * 2 for place in range(2)}
    for name, times in used.items():
        os.utime(tmp_path / "sculpts" / name, times)
    kept_sculpts._tidy()
    left = {path.relative_to(tmp_path / "sculpts").as_posix() for path in (tmp_path / "sculpts").rglob("*")}
    assert left == {"place0", *(f"place0/{n}.npz" for n in (2, 3, 4))}
    assert (tmp_path / "sculpts" / "place0").stat().st_mtime == used["place0"][1], "to be trimmed is no use of it"
