"""The same world with one thing changed, where an author's law acts: it goes on, and is asked as often."""

import json
import os
from pathlib import Path

import pytest

from forked_engine import forked_engine
from hung_springs import Springs, motor
from worldengine.recording import stored
from worldkit import handover, program


class Watched(Springs):
    """It hangs its weight higher once `control` has said so, by no input at all."""

    raised = False

    def step(self, model, data, seconds):
        self.length = 0.08 if self.raised else 0.1
        return super().step(model, data, seconds)


def simulated(folder: Path, control=None, law=None, duration: float = 0.05, every: int = 1, step=0.001, more=()):
    def build():
        spec = motor()
        spec.option.timestep = step
        return spec

    words = ["--pass", "physics", "--out", str(folder), *more]
    settings = {"duration": duration, "control_every": every, "laws": [law or Springs()]}
    with forked_engine():
        assert program.main(build, control, argv=words, **settings) == 0, (folder / "error.json").read_text()
    return stored.open(folder / "trajectory")


def test_without_control_a_law_goes_on_and_nothing_else_does(tmp_path: Path) -> None:
    law = Watched()

    def control(model, data):
        data.ctrl[0] = 5.0
        law.raised = True

    alone = simulated(tmp_path / "alone", law=Watched())
    driven = simulated(tmp_path / "driven", control, law)
    law.raised = False
    without = simulated(tmp_path / "without", control, law, more=["--without", "control"])
    assert set(driven.interventions.kind) == {"force", "control"} and set(without.interventions.kind) == {"force"}
    assert without.sha256 == alone.sha256 != driven.sha256
    assert len(without.balances) == len(driven.balances) and not law.raised


@pytest.mark.parametrize(("step", "every"), [(0.003, 3), (0.0035, 2)])
def test_at_half_the_step_a_law_is_asked_as_often_and_the_end_is_the_same(tmp_path: Path, step, every) -> None:
    """1 s is no whole number of either step; rounded, half the step gives one step more than twice as many."""
    whole, half = (
        simulated(tmp_path / name, duration=1.0, every=every, step=step, more=more)
        for name, more in (("whole", []), ("half", ["--time-step-factor", "0.5"]))
    )
    assert half.time == pytest.approx(whole.time) and (2 * whole.balances.step == half.balances.step).all()
    told = [json.loads((tmp_path / name / "result.json").read_text())["steps"] for name in ("whole", "half")]
    assert told[1] == 2 * told[0]


def test_a_forked_engine_ends_as_one_by_itself(capfd: pytest.CaptureFixture[str]) -> None:
    """An exit keeps its code, what it says is told, and it has the environment that it is given: COLUMNS wide, here."""
    lines = []
    with forked_engine():
        for wide in ("60", "200"):
            call = handover._call(["no such pass"])
            assert handover.subprocess.run(call, env={**os.environ, "COLUMNS": wide}).returncode == 2
            lines.append(capfd.readouterr().err.count("\n"))
    assert lines[0] > lines[1] > 1
