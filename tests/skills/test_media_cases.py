"""The worked cases of the skills `media` and `breakable-things`: each plan stands, its draft is whole and builds, and its film can be told."""

import runpy
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from worldkit.filming import Film, Recorded
from worldwright.draft import assembly
from worldwright.lint import tools as lint
from worldwright.model.plan.layout import Scene
from worldwright.model.plan.plan_text import read_plan
from worldwright.place import tools as place

SKILLS = Path(__file__).parents[2] / "skills"
CASES = sorted(
    path.parent for skill in ("media", "breakable-things") for path in SKILLS.glob(f"{skill}/references/*/plan.md")
)


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_its_skill_names_it(case: Path) -> None:
    assert f"references/{case.name}/" in (case.parents[1] / "SKILL.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
def test_a_case_is_drafted_whole_and_builds(case: Path, tmp_path: Path) -> None:
    case = shutil.copytree(case, tmp_path / case.name)
    found = (*lint.check_plan(case / "plan.md").findings, *place.check(case / "plan.md").findings)
    assert [one for one in found if one.severity == "error"] == []
    plan = read_plan(case / "plan.md").plan
    made = assembly.draft(plan, Scene(objects=place.resolve(case / "plan.md", write=False).objects))
    assert made.complete and not made.unread, (made.open_places, made.unread)
    (case / "simulation.py").write_text(made.source, encoding="utf-8")
    subprocess.run([sys.executable, "simulation.py", "--pass", "build", "--out", "world"], cwd=case, check=True)
    assert (case / "world/world.mjz").is_file()
    moves = {name: np.zeros((30, 3)) for name in (*plan.movers(), *(row.name for row in plan.scene_objects))}
    film = Film(Recorded.rehearsal(moves, duration=float(plan.simulation_parameters.simulation_duration)))
    runpy.run_path(str(case / "film.py"))["film"](film)
    assert film.description()[0]["shots"]
