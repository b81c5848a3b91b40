"""The worked cases of the skill `fields`: each plan stands, its world does what it claims, and its film can be told."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from worldengine.film import motion_facts
from worldengine.recording import stored
from worldkit.filming import Film, Recorded
from worldwright.lint import tools as lint
from worldwright.lint.compiled import planned
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.place import tools as place
from worldwright.scan.objectives import expecting
from worldwright.stage import tools as stage

CASES = Path(__file__).parents[2] / "skills/fields/references"
NAMES = sorted(path.parent.name for path in CASES.glob("*/plan.md"))


def test_there_are_three_and_the_skill_names_each() -> None:
    page = (CASES.parent / "SKILL.md").read_text(encoding="utf-8")
    assert len(NAMES) == 3 and all(f"references/{name}/" in page for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_stands(name: str) -> None:
    path = CASES / name / "plan.md"
    found = (*lint.check_plan(path).findings, *place.check(path).findings)
    assert [one for one in found if one.severity == "error"] == []


@pytest.mark.parametrize("name", NAMES)
def test_a_case_does_what_it_claims(name: str, tmp_path: Path) -> None:
    plan = read_plan(CASES / name / "plan.md").plan
    (tmp_path / "simulation.py").write_text(planned.source(plan), encoding="utf-8")
    (tmp_path / "inputs.json").write_text(json.dumps(stage.declared_inputs(CASES / name / "plan.md")))
    words = ["--pass", "build", "--out", "world"]
    subprocess.run([sys.executable, "simulation.py", *words], cwd=tmp_path, check=True)
    (tmp_path / "run").mkdir()
    words = ["physics", "--world", "world/world.mjz", "--program", "world/program.json", "--inputs", "inputs.json"]
    subprocess.run([sys.executable, "-m", "worldengine", *words, "--out", "run"], cwd=tmp_path, check=True)
    told = expecting.expect(read_trajectory(tmp_path / "run/trajectory"), plan).objectives
    assert [o.status for o in told] == ["proved"] * len(plan.objectives), told
    recording = stored.open(tmp_path / "run/trajectory")
    motion_facts.write(recording, tmp_path / "motion.npz", {"fps": 24, "size": [160, 90], "movers": plan.movers()})
    with np.load(tmp_path / "motion.npz") as arrays:
        film = Film(Recorded(dict(arrays)))
    space: dict[str, object] = {}
    exec((CASES / name / "film.py").read_text(encoding="utf-8"), space)
    space["film"](film)  # type: ignore[operator]
    assert film.description()[0]["shots"]
