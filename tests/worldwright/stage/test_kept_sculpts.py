"""What is sculpted is made once, outside every pass; nobody but the file itself can say what it makes."""

import os
import uuid

import pytest

from worldwright.lint import tools as lint
from worldwright.model.evidence.run import Run
from worldwright.model.plan.plan_text import read_plan
from worldwright.stage import kept_sculpts, sculpting_step
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


def test_it_is_made_once_for_lint_sheet_and_all_passes(run, finish):
    plan = read_plan(run.plan).plan
    assert sculpting_step.prepare(plan) == 1
    assert sculpting_step.prepare(plan) == 0
    made = entries(run)
    assert len(made) == 1
    stage.sheet(str(run.folder / "sculpt/bowl.py"))
    from worldwright.draft.writing import write_program
    from worldwright.stamp import tools as stamp

    stamp.approve(str(run.folder), by="tester")
    write_program(run)
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
        "from worldkit.sculpt import keeping\n"
        "for place in os.environ['WORLDKIT_SCULPT_GIVEN'].split(os.pathsep):\n"
        "    for path in pathlib.Path(place).glob('*.npz'):\n"
        "        key = path.name[:24]\n"
        "        keeping.keep(key, {'poison': keeping.np.zeros(3)})\n"
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
