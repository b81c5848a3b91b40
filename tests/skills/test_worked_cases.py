"""The worked cases of the skill `worked-cases`: each plan stands, does what it claims, and its film shows who does it."""

import json
import math
import runpy
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

from forked_engine import forked_engine
from worldengine.film import described, light_meter, motion_facts
from worldengine.film.directed import Screening
from worldengine.recording import stored
from worldkit import portable
from worldkit.filming import Film, Recorded
from worldwright.lint import tools as lint
from worldwright.lint.compiled import planned
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.place import tools as place
from worldwright.scan.objectives import expecting

CASES = Path(__file__).parents[2] / "skills/worked-cases/references"
NAMES = sorted(path.parent.name for path in CASES.glob("*/plan.md"))
SIZE = (160, 90)
SHARE = 0.005
"""What moves covers so much of a picture where it is seen best: a pendulum's rod and bob 0.8 %, dominoes ten times as much."""


class Filmed:
    """A case that has run: its plan, its recording, and its film as its author tells it."""

    def __init__(self, name: str, folder: Path) -> None:
        case, self.folder = folder / name, folder
        self.plan = read_plan(case / "plan.md").plan
        (case / "simulation.py").write_text(planned.source(self.plan), encoding="utf-8")
        with forked_engine():
            runpy.run_path(str(case / "simulation.py"), run_name="__main__")
        self.recording = stored.open(folder / "run/trajectory")
        facts = {"fps": 24, "size": list(SIZE), "movers": self.plan.movers()}
        motion_facts.write(self.recording, folder / "motion.npz", facts)
        with np.load(folder / "motion.npz") as arrays:
            film = Film(Recorded(dict(arrays)))
        runpy.run_path(str(case / "film.py"))["film"](film)
        self.facts, arrays = film.description()
        np.savez(folder / "film.npz", **arrays)

    def readings(self, **changes: object) -> list[dict]:
        """What a light meter reads in three frames of the film, with the pixels of what moves."""
        (self.folder / "film.json").write_text(json.dumps(self.facts | changes))
        world = self.folder / "run/world.mjz"
        film = described.read(self.folder, self.recording)
        with Screening(world, portable.read(world), self.recording, film, SIZE, 24, "preview") as screening:
            return [
                light_meter.reading(screening.model, picture, screening.layers(), self.plan.movers())
                for picture in (screening.picture(film.frames * quarter // 4) for quarter in (1, 2, 3))
            ]


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
def test_a_case_does_what_it_claims_and_its_film_shows_who_does_it(name, tmp_path, monkeypatch):
    case = filmed(name, tmp_path, monkeypatch)
    told = expecting.expect(read_trajectory(tmp_path / "run/trajectory"), case.plan).objectives
    assert [o.status for o in told] == ["proved", "visual_only"], told
    read = case.readings()
    for one in read:
        assert 0.06 < one["luma"] < 0.85 and one["contrast"] > 0.06, "neither black, white nor grey"
    if case.facts.get("surfaces"):  # what it stands for is counted where it is
        read = case.readings(surfaces=[])
    assert max(sum(one["subjects"].values()) for one in read) > SHARE * math.prod(SIZE), "what moves is seen"
