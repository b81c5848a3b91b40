"""What an author's law may not be or do is refused with its cause, whatever the engine would make of it."""

import json
import sys
from pathlib import Path

import pytest

from hung_springs import Springs, motor, run, world
from worldengine.inputs.declared_media import Medium
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
