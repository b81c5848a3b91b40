"""The worked cases of the skill `worked-cases`: each plan stands, its program is what the plan says, and its film can be drawn."""

import json
import runpy
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from worldengine.film import described, motion_facts
from worldengine.film.directed import Screening
from worldengine.recording import stored
from worldkit import portable
from worldkit.filming import Film, Recorded
from worldwright.lint import tools as lint
from worldwright.model.plan.plan_text import read_plan
from worldwright.place import tools as place

CASES = Path(__file__).parents[2] / "skills/worked-cases/references"
NAMES = sorted(path.parent.name for path in CASES.glob("*/plan.md"))
SIZE = (160, 90)


class Filmed:
    """A case that has run: its plan, its recording, and its film as its author tells it."""

    def __init__(self, name: str, folder: Path) -> None:
        case, self.folder = folder / name, folder
        self.plan = read_plan(case / "plan.md").plan
        runpy.run_path(str(case / "simulation.py"), run_name="__main__")
        self.recording = stored.open(folder / "run/trajectory")
        facts = {"fps": 24, "size": list(SIZE), "movers": list(self.recording.meta.get("movers") or ())}
        motion_facts.write(self.recording, folder / "motion.npz", facts)
        with np.load(folder / "motion.npz") as arrays:
            film = Film(Recorded(dict(arrays)))
        runpy.run_path(str(case / "film.py"))["film"](film)
        self.facts, arrays = film.description()
        (folder / "film.json").write_text(json.dumps(self.facts))
        np.savez(folder / "film.npz", **arrays)

    def screening(self, size: tuple[int, int] = SIZE, renderer: str = "preview") -> Screening:
        world = self.folder / "run/world.mjz"
        film = described.read(self.folder, self.recording)
        return Screening(world, portable.read(world), self.recording, film, size, 24, renderer)


def filmed(name: str, folder: Path, monkeypatch) -> Filmed:
    """Run a copy of a case in `folder`, and film it."""
    case = shutil.copytree(CASES / name, folder / name)
    monkeypatch.setattr(sys, "argv", [str(case / "simulation.py"), "--pass", "physics", "--out", str(folder / "run")])
    monkeypatch.syspath_prepend(case)
    monkeypatch.chdir(case)
    return Filmed(name, folder)


def test_there_are_five_and_the_skill_names_each():
    page = (CASES.parent / "SKILL.md").read_text(encoding="utf-8")
    assert len(NAMES) == 5 and all(f"references/{name}/" in page for name in NAMES)


@pytest.mark.parametrize("name", NAMES)
def test_a_plan_stands(name):
    path = CASES / name / "plan.md"
    found = (*lint.check_plan(path).findings, *place.check(path).findings)
    assert [one for one in found if one.severity == "error"] == []


@pytest.mark.gl
@pytest.mark.parametrize("name", NAMES)
def test_a_case_runs_and_its_film_shows_what_it_is_about(name, tmp_path, monkeypatch):
    case = filmed(name, tmp_path, monkeypatch)
    moved = np.linalg.norm(np.ptp(case.recording.pos, axis=0), axis=-1)
    assert moved.max() > 0.01 and np.isfinite(case.recording.pos).all()
    with case.screening() as screening:
        frames = [screening.picture(frame) for frame in (0, len(screening.film.arrays["eye"]) // 2)]
    assert np.abs(frames[0].astype(int) - frames[1]).max() > 40, "something is seen to move"
    for frame in frames:
        assert 0.06 < frame.mean() / 255 < 0.85 and frame.std() > 15, "neither black, white nor grey"
