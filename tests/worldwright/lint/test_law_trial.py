"""An author's law is stepped for a fifth of a second before its physics is paid for."""

import io
import json
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from worldwright.lint.compiled import law_trial
from worldwright.model.errors import CallOverError
from worldwright.model.plan import law_costs
from worldwright.scan.known import own_laws
from worldwright.scan.tools import unbalanced
from worldwright.stage import tools as stage

PROGRAM = """\
import mujoco
from laws.spring import Spring
from worldkit import program, scene


def build():
    spec = scene.new("spring", time_step=0.002)
    body = spec.worldbody.add_body(name="ball", pos=(0, 0, 1))
    body.add_freejoint()
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.05, 0, 0], mass=1.0)
    shown = spec.worldbody.add_body(name="bob", pos=(0, 0, 0.5))
    shown.add_geom(type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[0.05, 0, 0], contype=0, conaffinity=0, mass=0)
    return spec


if __name__ == "__main__":
    program.main(build, duration=2.0, control_every=5, laws=[Spring()])
"""
LAW = """\
import numpy as np


class Spring:
    name, bodies, shown_by = "spring", ("ball",), "bob"

    def start(self, model, data):
        self.points, self.velocities = np.array([[0.0, 0.0, 0.5]]), np.zeros((1, 3))
        self.mass, self.at = np.array([1.0]), np.array([0.0, 0.0, 1.0])

    def step(self, model, data, seconds):
        parts, given = 20, np.zeros(3)
        h = seconds / parts
        for n in range(parts):
            self.at = data.body("ball").xipos + n * h * data.body("ball").cvel[3:]
            force = 50.0 * (self.at - self.points[0])
            self.velocities[0] += h * (force + self.mass[0] * model.opt.gravity)
            self.points += h * self.velocities
            given -= force / parts
        return [{felt} * given]

    def energy(self):
        {raises}
        return 25.0 * float(((self.at - self.points[0]) ** 2).sum())
"""


def tried(folder: Path, felt: float = 1.0, raises: str = "") -> law_trial.Tried:
    (folder / "laws").mkdir()
    (folder / "laws" / "spring.py").write_text(LAW.replace("{felt}", str(felt)).replace("{raises}", raises or "pass"))
    (folder / "simulation.py").write_text(PROGRAM)
    found = law_trial.tried(folder / "simulation.py", 2.0)
    assert found is not None
    return found


def test_one_that_balances_is_told_with_its_cost(tmp_path: Path) -> None:
    found = tried(tmp_path)
    assert found.findings == () and "the whole 2 s about" in found.said and "sums balance" in found.said, found


def test_one_whose_body_does_not_feel_it_is_told_at_once(tmp_path: Path) -> None:
    (finding, *_) = tried(tmp_path, felt=0.0).findings
    assert finding.code == "WS318" and "momentum from nowhere" in finding.message


@pytest.mark.parametrize("raises", ["return self.stored"])
def test_one_that_fails_is_told_with_its_line(tmp_path: Path, raises: str) -> None:
    (finding,) = tried(tmp_path, raises=raises).findings
    assert finding.severity == "error" and "spring.py:23" in finding.message and "stored" in finding.message


def test_sums_that_are_no_numbers_are_told(tmp_path: Path) -> None:
    (finding,) = tried(tmp_path, raises="return float('nan')").findings
    assert "not finite" in finding.message or "nan" in finding.message, finding


def test_the_cheaper_choice_is_named_where_the_whole_is_long() -> None:
    short, long = (law_costs.told(7144, 0.2, wall_s, 1.0, 8.0) for wall_s in (1.0, 11.0))
    assert "7,144 points" in long and "8 s about 440 s" in long and "fewer points" in long
    assert "about 40 s" in short and "fewer points" not in short
    waits = law_costs.told(7144, 0.2, 1.2, 4643.6, 8.0)
    assert "not known" in waits and "e+05" not in waits, "what starts later says nothing of the whole"


@pytest.mark.parametrize(
    ("status", "outcome", "said"),
    [
        ("out_of_memory", b"", "more than 4096 MB"),
        ("timed_out", b'{"reached_s": 0.1, "wall_s": 1.0, "memory_mb": 1700.4}', "1700 MB"),
        ("timed_out", b'{"reached_s": 0.1, "wall_s": 1.0, "memory_mb": 450}', ""),
    ],
)
def test_a_law_that_leaves_little_memory_is_told_before_its_physics(
    status: str, outcome: bytes, said: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    done = SimpleNamespace(status=status, files={"outcome.json": outcome})
    monkeypatch.setattr("worldwright.stage.tools.run_confined", lambda *_, **__: done)
    found = law_trial.tried(tmp_path / "simulation.py", 2.0)
    assert found is not None and not found.findings
    assert ("--memory-mb" in found.said) == bool(said) and said in found.said


def test_without_time_for_it_the_trial_says_so(tmp_path: Path) -> None:
    found = law_trial.tried(tmp_path / "simulation.py", 2.0, wall_s=1.0)
    assert found is not None and "not known" in found.said and not found.findings


def test_a_call_that_ends_meanwhile_takes_no_finding_away(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def over(*given: object) -> None:
        raise CallOverError("over")

    monkeypatch.setattr(law_trial, "tried", over)
    (tmp_path / "simulation.py").write_text(PROGRAM)
    row = SimpleNamespace(solver=SimpleNamespace(file="laws/spring.py"))
    plan = SimpleNamespace(simulation_parameters=SimpleNamespace(interventions=(row,), simulation_duration=2.0))
    said = law_trial.of(tmp_path / "simulation.py", plan, SimpleNamespace(status="compiled"), [], 20.0)
    assert said == law_trial.Tried(law_trial.UNTRIED), "and it is not silent about the price"


def test_a_law_is_asked_however_long_its_world_took_to_build(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """On a busy machine the clock on the wall went by while the world was built, and physics began without a price."""
    given: list[float] = []
    monkeypatch.setattr(law_trial, "tried", lambda program, lasting, wall_s: given.append(wall_s))
    (tmp_path / "simulation.py").write_text(PROGRAM.replace("duration=2.0", "duration=float('2')"))
    row = SimpleNamespace(solver=SimpleNamespace(file="laws/spring.py"))
    plan = SimpleNamespace(simulation_parameters=SimpleNamespace(interventions=(row,), simulation_duration=2.0))
    for left_s in (-43.0, 18.0):
        law_trial.of(tmp_path / "simulation.py", plan, SimpleNamespace(status="compiled"), [], left_s)
    assert given == [law_trial.OWN_S, 18.0]


@pytest.mark.parametrize("status", ["out_of_memory", "timed_out"])
def test_a_trial_that_is_ended_tells_what_it_came_to(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, status: str
) -> None:
    from worldwright.stage import tools

    told = {"points": 8200, "reached_s": 0.1, "wall_s": 0.5, "grows": 20.0}
    files = {"outcome.json": json.dumps(told).encode()}
    monkeypatch.setattr(tools, "run_confined", lambda *_, **__: SimpleNamespace(status=status, files=files))
    found = law_trial.tried(tmp_path / "simulation.py", 5.0)
    assert found is not None and "the whole 5 s about 500 s" in found.said and "fewer points" in found.said
    assert ("more than 4096 MB" in found.said) == (status == "out_of_memory")


def lying(made_j: float, cell: float) -> own_laws.LawBalance:
    """27 g of honey that lies in a spoon for 0.2 s, hardly stores anything, and gains some energy."""
    t = np.linspace(0.0, 0.2, 51)
    mass, stored = np.full(51, 0.027), 8e-5 * t / t[-1]
    held = np.outer(t, mass[0] * np.array([0.0, 0.0, -9.81]))
    return own_laws.LawBalance(
        "honey", ("spoon",), t, mass=mass, momentum=0 * held, energy=stored + (made_j - 8e-5) * t / t[-1], weight=0 * t,
        stored=stored, volume=0 * t, given=0 * held, held=held, work=0 * t, pushed=0.0, gravity=np.array([0.0, 0.0, -9.81]), cell=cell,
    )  # fmt: skip


def test_noise_of_what_lies_still_on_a_grid_is_none_and_a_gain_that_lifts_it_is_told() -> None:
    assert unbalanced((lying(3.26e-5, cell=0.0),)), "as it was told of honey at rest"
    assert unbalanced((lying(3.26e-5, cell=0.0052),)) == []
    (told,) = unbalanced((lying(3.26e-4, cell=0.0052),))
    assert "24% of what it stores" in told


@pytest.mark.parametrize("suites", [True, False])
def test_the_remedy_is_the_authors_or_that_of_the_suites_own_law(tmp_path: Path, monkeypatch, suites: bool) -> None:
    law = {"name": "spring", "bodies": ["ball"], "suites": suites, "cell": 0.005}
    outcome = {"laws": [law], "points": 1, "reached_s": 0.2, "wall_s": 0.1, "grows": 1.0}
    sums, times = np.zeros((1, 11, 15)), np.linspace(0.0, 0.2, 11)
    sums[0, :, 0], sums[0, :, 1] = 1.0, times
    kept = io.BytesIO()
    np.savez(kept, t=times, sums=sums, pushed=np.zeros(1), gravity=np.zeros(3))
    files = {"outcome.json": json.dumps(outcome).encode(), "sums.npz": kept.getvalue()}
    monkeypatch.setattr(stage, "run_confined", lambda *_, **__: SimpleNamespace(files=files, status="ended"))
    (tmp_path / "simulation.py").write_text(PROGRAM)
    (finding,) = law_trial.tried(tmp_path / "simulation.py", 2.0).findings
    assert ("smaller `spacing`" in finding.fix) == suites and ("energy()" in finding.fix) != suites
