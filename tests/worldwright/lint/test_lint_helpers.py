"""A program may be spread over modules and data beside it: lint judges the whole, and fences nothing in."""

import pytest

from worldwright.draft import draft
from worldwright.lint import engine, source
from worldwright.lint.program_view import Program
from worldwright.lint.tools import check_program
from worldwright.model.plan.plan_text import read_plan
from worldwright.place.tools import laid_out


@pytest.fixture
def spread(tmp_path, small_plan):
    """A run whose world is made by `laws/world.py`, which takes its cameras' names from a table."""
    (tmp_path / "laws").mkdir()
    (tmp_path / "data").mkdir()
    (tmp_path / "plan.md").write_text(small_plan)
    plan = read_plan(tmp_path / "plan.md").plan
    head, main = draft(plan, laid_out(plan)).source.split("\nif __name__", 1)
    (tmp_path / "data/names.csv").write_text("overview,side\n")
    head = head.replace('"overview"', "NAMES[0]").replace('"side"', "NAMES[1]")
    table = "NAMES = (Path(__file__).parents[1] / 'data/names.csv').read_text().strip().split(',')\n"
    head = head.replace("import mujoco\n", "from pathlib import Path\n\nimport mujoco\nimport scipy.spatial\n").replace(
        "\nTIME_STEP", f"\n{table}TIME_STEP"
    )
    (tmp_path / "laws/world.py").write_text(head)
    text = "from laws.world import DURATION, build\nfrom worldkit import program\n\nif __name__" + main
    (tmp_path / "simulation.py").write_text(text)
    return tmp_path


def test_a_world_that_a_module_beside_the_program_makes_is_judged_as_built(spread):
    found = check_program([spread / "simulation.py"]).findings
    assert [f.text() for f in found if f.severity == "error"] == []
    world = spread / "laws/world.py"
    world.write_text(world.read_text().replace("TIME_STEP = ", "TIME_STEP = 2 * "))
    assert "WM" in {f.code[:2] for f in check_program([spread / "simulation.py"]).findings if f.severity == "error"}


def test_what_no_file_names_is_missing_all_the_same(spread):
    (spread / "data/names.csv").write_text("overview,other\n")
    program = Program(source.read(spread / "simulation.py"), read_plan(spread / "plan.md").plan)
    told = {rule.CODE: list(rule.check(program)) for rule in engine.program_rules() if rule.CODE in ("WL123", "WL124")}
    assert told["WL123"] == [] and "`side`" in told["WL124"][0].message
