"""What a file beside the plan sculpts is planned, drafted, approved and held to its plan like anything else."""

import pytest

from worldwright.draft.writing import write_program
from worldwright.lint.tools import check_plan, check_program
from worldwright.model.errors import GateError, PlanError
from worldwright.model.evidence import approval
from worldwright.model.evidence.run import Run
from worldwright.model.plan import imported
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.tools import laid_out
from worldwright.stamp import tools as stamp

BOWL = """\
import shades
from worldkit import sculpt

ROUND = sculpt.sphere(0.2).shell(0.02) - sculpt.half_space((0, 0, -1), 0.0)
POT = sculpt.Part("pot", ROUND - sculpt.half_space((0, 0, 1), -0.09), look=shades.CLAY, make={"cells": 24})
LID = sculpt.Part("pot", sculpt.cylinder(0.2, 0.09).translate(0, 0, -0.045), make={"cells": 24})
"""


@pytest.fixture
def run(tmp_path, sculpted_plan):
    (tmp_path / "sculpt").mkdir()
    (tmp_path / "plan.md").write_text(sculpted_plan)
    (tmp_path / "sculpt/bowl.py").write_text(BOWL)
    (tmp_path / "sculpt/shades.py").write_text('CLAY = "#b5653a"\n')
    return Run(tmp_path)


def errors(report):
    return {f.code for f in report.findings if f.severity == "error"}


def changed(run, *changes):
    text = run.plan.read_text()
    for before, after in changes:
        assert before in text
        text = text.replace(before, after)
    run.plan.write_text(text)


def drafted(run):
    stamp.approve(str(run.folder), by="tester")
    assert write_program(run).open_places == ()
    return run.program.read_text()


def test_it_is_drafted_whole_and_its_world_is_what_the_plan_says(run):
    assert errors(check_plan(run.plan)) == set()
    assert laid_out(read_plan(run.plan).plan)["bowl"].size == (0.2, 0.2, 0.09)
    source = drafted(run)
    assert 'sculpt.from_file(spec, "sculpt/bowl.py", name="bowl"' in source and 'of="POT"' in source
    assert errors(check_program([run.program])) == set()
    # The same shape built by hand is the same body; another one with its box is not.
    by_hand = source.replace('sculpt.from_file(spec, "sculpt/bowl.py", ', "made_by_hand(spec, ").replace(
        'of="POT", ', ""
    )
    by_hand = by_hand.replace("\ndef build", "\nimport shape_of\n\n\ndef build").replace("made_by_hand", "shape_of.add")
    helper = "import sys\nfrom pathlib import Path\n\nfrom worldkit import sculpt\n\nsys.path.append(str(Path(__file__).parent / 'sculpt'))\n"
    add = "from sculpt.bowl import {}\n\n\ndef add(spec, **words):\n    return sculpt.add(spec, {}.shape, look='#b5653a', cells=24, **words)\n"
    run.program.write_text(by_hand)
    found = {}
    for name in ("POT", "LID"):
        (run.folder / "shape_of.py").write_text(helper + add.format(name, name))
        found[name] = errors(check_program([run.program]))
    assert found["POT"] == set() and "WM170" in found["LID"]


def test_a_size_that_the_file_does_not_make_is_told(run):
    changed(run, ("size: [0.2, 0.2, 0.09]", "size: [0.2, 0.2, 0.12]"))
    drafted(run)
    assert "WM151" in errors(check_program([run.program]))


def test_what_it_reads_is_approved_with_the_plan(run):
    assert set(approval.model_hashes(run)) == {"sculpt/bowl.py", "sculpt/shades.py"}
    stamp.approve(str(run.folder), by="tester")
    (run.folder / "sculpt/shades.py").write_text('CLAY = "#000000"\n')
    with pytest.raises(GateError, match=r"sculpt/shades\.py, which the plan names, changed"):
        write_program(run)


@pytest.mark.parametrize(
    ("changes", "codes"),
    [
        ([("sculpt/bowl.py:POT", "sculpt/gone.py")], {"WP126"}),
        ([("sculpt/bowl.py:POT", "../bowl.py")], {"WP126"}),
        ([("## asset_dimensions\n", "## asset_dimensions\n\n- bowl: 0.1\n")], {"WP112"}),
        ([("density: 1900, ", ""), ("masses: {pea: 0.004}", "masses: {pea: 0.004}")], {"WP108"}),
    ],
)
def test_a_row_that_cannot_be_is_told(run, changes, codes):
    changed(run, *changes)
    assert codes <= errors(check_plan(run.plan))


@pytest.mark.parametrize(
    ("before", "after", "said"),
    [
        (", size: [0.2, 0.2, 0.09]", "", "needs `size"),
        ('type: sculpt, filename: "sculpt/bowl.py:POT"', "filename: mug", "is of a sculpt"),
    ],
)
def test_a_sculpture_has_a_size_and_nothing_else_has(run, before, after, said):
    changed(run, (before, after))
    with pytest.raises(PlanError) as refused:
        read_plan(run.plan)
    assert any(said in f.message + f.fix for f in refused.value.findings)


def test_its_files_go_where_the_plan_goes(run):
    assert sorted(imported.beside(run.folder)) == ["sculpt/bowl.py", "sculpt/shades.py"]
    (run.folder / "sculpt/bowl.py").write_text("def (")
    assert "WP126" in errors(check_plan(run.plan))
