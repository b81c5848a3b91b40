"""What an author's law may not be or do is refused with its cause, whatever the engine would make of it."""

import json
import sys
from pathlib import Path

import numpy as np
import pytest

from hung_springs import Springs, motor, run, world
from worldengine.inputs.declared_media import Medium
from worldengine.recording import stored
from worldkit import program
from worldkit.errors import ProgramError


def test_a_law_of_another_file_than_the_plans_is_refused(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    beside = Path(__file__).parents[1]
    monkeypatch.setattr(sys.modules["__main__"], "__file__", str(beside / "simulation.py"), raising=False)
    here = Medium("springs", ("weight",), "net", "hung_springs.py", world=True)
    kept = run(tmp_path / "here", rows=(here,), steps=3)
    assert kept.meta["laws"][0]["law"]["file"] == here.file and Medium.read(kept.meta["laws"][0]) == here
    for file in ("laws/springs.py", "elsewhere/hung_springs.py"):
        with pytest.raises(ProgramError, match=rf"springs stands in hung_springs.py, .* declares {file}"):
            run(tmp_path / "other", rows=(Medium("springs", ("weight",), "net", file, world=True),), steps=3)
    monkeypatch.setattr(sys.modules["__main__"], "__file__", str(beside.parent / "simulation.py"))
    with pytest.raises(
        ProgramError, match=rf"springs stands in {beside.name}/hung_springs.py, .* declares hung_springs.py"
    ):
        run(tmp_path / "elsewhere", rows=(here,), steps=3)


class Shrinking(Springs):
    left = slice(0, 2)

    def step(self, model, data, seconds):
        self.points, self.velocities, self.mass = (a[self.left] for a in (self.points, self.velocities, self.mass))
        return np.zeros((2, 3))


class ToOne(Shrinking):
    left = slice(0, 1)


class Ragged(Springs):
    def step(self, model, data, seconds):
        self.points = [[0.0], [0.0, 1.0]]
        return np.zeros((2, 3))


class RaggedForces(Springs):
    def step(self, model, data, seconds):
        return [[0.0], [0.0, 1.0]]


class Wordy(Springs):
    def start(self, model, data):
        super().start(model, data)
        self.mass = ["a", "b", "c"]


@pytest.mark.parametrize(
    ("law", "says"),
    [
        (Shrinking, r"points of the shape \(2, 3\), and net shows 3 points"),
        (ToOne, r"points of the shape \(1, 3\), and net shows 3 points"),
        (Ragged, r"points of the law springs failed at t = 0.0000 s: ValueError"),
        (RaggedForces, r"step of the law springs failed at t = 0.0000 s: ValueError"),
        (Wordy, r"has mass that are no numbers"),
    ],
)
def test_points_and_forces_of_another_shape_are_refused_whenever_they_are(tmp_path: Path, law, says: str) -> None:
    with pytest.raises(ProgramError, match=says) as caught:
        run(tmp_path / "out", law(), steps=20)
    assert caught.value.next_move


def test_lists_are_numbers_too(tmp_path: Path) -> None:
    class Listed(Springs):
        def start(self, model, data):
            super().start(model, data)
            self.mass = list(self.mass)

        def step(self, model, data, seconds):
            self.mass = np.asarray(self.mass)
            forces = super().step(model, data, seconds)
            self.mass, self.points = list(self.mass), self.points.tolist()
            return forces.tolist()

    listed, plain = run(tmp_path / "listed", Listed(), steps=20), run(tmp_path / "plain", steps=20)
    assert stored.inputs_digest(listed.folder) == stored.inputs_digest(plain.folder)


class Stubborn(Springs):
    """It keeps to the gravity that there was."""

    def start(self, model, data):
        super().start(model, data)
        self.gravity = model.opt.gravity.copy()


def test_gravity_is_for_no_one_to_write(tmp_path: Path) -> None:
    class Weightless(Springs):
        def start(self, model, data):
            super().start(model, data)
            model.opt.gravity[:] = 0.0

    def control(model, data):
        model.opt.gravity[:] = 0.0

    with pytest.raises(ProgramError, match=r"a law writes model.opt.gravity"):
        run(tmp_path / "law", Weightless(), steps=5)
    drive = (("control", frozenset({"pull"})),)
    plain, other = (
        run(tmp_path / f"{by}", Stubborn(), motor(), others=drive, steps=20, control=by) for by in (None, control)
    )
    assert (other.balances.weight == plain.balances.weight).all() and plain.balances.weight.all()


class Doubled(Springs):
    bodies = ("weight", "world", "weight")


def test_a_law_that_names_a_body_twice_is_refused(tmp_path: Path) -> None:
    words = ["--pass", "build", "--out", str(tmp_path)]
    assert program.main(lambda: world(), duration=0.05, laws=[Doubled()], argv=words) == 1
    said = json.loads((tmp_path / "error.json").read_text())
    assert "springs names its body weight twice" in said["message"]
