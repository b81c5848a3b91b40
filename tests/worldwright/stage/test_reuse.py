"""A repair that changes only what is seen pays for no physics, and anything else does."""

import json
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement
from worldwright.stamp import tools as stamp

Copy = Callable[[Path], Path]


def physics(folder: Path, **options: object):
    lint.check_program([folder / "simulation.py"])
    job = stage.start(str(folder), **options)
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text()
    return job


def result(run: Run) -> dict:
    folder = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    return json.loads((folder / "result.json").read_text())


def patch(folder: Path, old: str, new: str) -> None:
    program = folder / "simulation.py"
    source = program.read_text(encoding="utf-8")
    assert old in source
    program.write_text(source.replace(old, new), encoding="utf-8")


CAMERA = ('if __name__ == "__main__":', '\n_build = build\n\n\ndef build() -> mujoco.MjSpec:\n    """With one more camera."""\n    spec = _build()\n    cameras.add(spec, "close", view="top_down", subjects=("ball",))\n    return spec\n\n\nif __name__ == "__main__":')  # fmt: skip


@pytest.fixture
def ran(reviewed: Path, copy: Copy) -> Path:
    """A run whose physics is recorded; that it is drawn and measured, too, changes nothing here."""
    return copy(reviewed)


def test_a_camera_repair_takes_the_recording_over_to_acceptance(ran: Path) -> None:
    folder = ran
    run = Run(folder)
    first = result(run)
    assert first["summary"]["steps"] > 0
    assert "reused_from" not in first["summary"]
    first_key = run.evidence_key(environment.current().sha256()).key

    patch(folder, *CAMERA)
    job = physics(folder)
    second = result(run)
    assert second["summary"]["reused_from"] == first_key
    assert second["summary"]["trajectory_sha256"] == first["summary"]["trajectory_sha256"]
    assert "only cameras, lights or looks differ" in job.text()
    here = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    assert all(sha256_file(here / name) == sha256 for name, sha256 in second["files"].items())
    meta = json.loads((here / "trajectory" / "meta.json").read_text())
    assert "close" in meta["cameras"]

    step = next(s for s in stamp.status(str(folder)).steps if s.name == "physics")
    assert step.detail == f"recording of {first_key} taken over: only the pictures differ"
    for name in ("stills", "video"):
        physics(folder, stage=name)
    assert (here.parent / "stills" / "close.png").is_file()
    assert scan.scan(str(folder)).ok
    assert scan.expect(str(folder)).ok
    stamp.describe(str(folder), by_measurement.describe(run))
    stamp.review(str(folder), by_measurement.review(run))
    accepted = stamp.accept(str(folder), timeout_s=60)  # simulates anew: what was taken over is proved
    assert accepted.ok
    assert accepted.trajectory_sha256 == first["summary"]["trajectory_sha256"]


@pytest.mark.parametrize(
    "change",
    [
        ("    return spec", "    spec.option.ls_iterations = 60\n    return spec"),
        ("    return spec", "    spec.option.tolerance = 1e-9\n    return spec"),
        ("    return spec", "    spec.option.iterations = 107\n    return spec"),
    ],
)
def test_a_change_of_the_physics_is_simulated(ran: Path, change: tuple[str, str]) -> None:
    before = result(Run(ran))["summary"]
    patch(ran, *change)
    physics(ran)
    now = result(Run(ran))["summary"]
    assert "reused_from" not in now
    assert now["motion_key"] != before["motion_key"]


def test_a_look_costs_nothing_and_force_simulates(ran: Path) -> None:
    patch(ran, "    return spec", '    spec.geom("ball").rgba = (0.0, 0.3, 1.0, 1.0)\n    return spec')
    physics(ran)
    assert result(Run(ran))["summary"]["reused_from"]
    forced = physics(ran, force=True)
    assert "the same result as before" in forced.text()


def test_a_variant_is_taken_over_too(ran: Path) -> None:
    from worldwright.stage.variants import folder
    from worldwright.stage.variants import run as vary

    run = Run(ran)
    for expected in (None, "reused_from"):
        job = vary(run, "half", ("--time-step-factor", "0.5"))
        while not job.ended:
            job = stage.wait(str(ran), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
        summary = json.loads((folder(run, "half") / "result.json").read_text())["summary"]
        assert ("reused_from" in summary) == bool(expected)
        patch(ran, "    return spec", "    spec.visual.map.zfar = 60.0\n    return spec")
        physics(ran)


def test_a_recording_with_an_edited_byte_is_not_taken_over(ran: Path) -> None:
    run = Run(ran)
    here = run.evidence(run.evidence_key(environment.current().sha256())) / "physics" / "trajectory"
    rows = bytearray((here / "state.arrows").read_bytes())
    rows[len(rows) // 2] ^= 1
    (here / "state.arrows").write_bytes(bytes(rows))
    patch(ran, "    return spec", "    spec.visual.map.zfar = 60.0\n    return spec")
    physics(ran)
    assert "reused_from" not in result(run)["summary"]


def test_another_environment_is_never_answered_from(ran: Path) -> None:
    run = Run(ran)
    here = run.evidence(run.evidence_key(environment.current().sha256()))
    key = json.loads((here / "key.json").read_text())
    (here / "key.json").write_text(json.dumps({**key, "environment_sha256": "0" * 64}))
    patch(ran, "    return spec", "    spec.visual.map.zfar = 60.0\n    return spec")
    physics(ran)
    assert "reused_from" not in result(run)["summary"]
    shutil.rmtree(run.jobs)


LAW = '''
import numpy as np

from .shares import SHARE


class Breeze:
    """One grain that hangs still, and a push on the ball."""

    name, bodies, shown_by = "breeze", ("ball",), "grain"

    def start(self, model, data):
        self.points, self.velocities = np.array([[0.0, 0.0, 2.0]]), np.zeros((1, 3))
        self.mass = np.ones(1)

    def step(self, model, data, seconds):
        return np.array([[SHARE, 0.0, 0.0]])

    def energy(self):
        return 0.0
'''
ROW = """
interventions:
  - kind: solver
    bodies: [ball]
    law: "0.1 N along x"
    source: constants.breeze
    solver: {name: breeze, file: laws/breeze.py, shown_by: grain}
constants:
  breeze: {value: 0.1, unit: N, source: "felt as a breath of air"}
inferred:"""
GRAIN = '    moved_shapes.grains(spec, "grain", np.array([[0.0, 0.0, 2.0]]), 0.01, look="sand")\n    lights.add(spec, sky="overcast")\n    return spec'


@pytest.fixture
def pushed(planned: Path, copy: Copy, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A ball that a law of the author's pushes, run once; lint, which changes no motion, is not asked."""
    from worldwright.stage import gates

    folder = copy(planned)
    plan = folder / "plan.md"
    text = plan.read_text(encoding="utf-8")
    plan.write_text(text.replace("duration: 0.5", "duration: 0.02").replace("\ninferred:", ROW, 1), encoding="utf-8")
    (folder / "laws").mkdir()
    (folder / "laws" / "shares.py").write_text("SHARE = 0.1  # N\n", encoding="utf-8")
    (folder / "laws" / "breeze.py").write_text(LAW, encoding="utf-8")
    patch(
        folder,
        "import mujoco\n",
        "import mujoco\nimport numpy as np\n\nfrom laws.breeze import Breeze\nfrom worldkit import lights, moved_shapes\n",
    )
    patch(folder, "    return spec", GRAIN)
    patch(folder, "DURATION = 0.5", "DURATION = 0.02")
    patch(folder, "program.main(build, ", "program.main(build, laws=[Breeze()], ")
    monkeypatch.setattr(gates, "require", lambda *_: None)
    simulated(folder)
    return folder


def simulated(folder: Path) -> dict:
    job = stage.start(str(folder))
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=30)
    assert job.state == "succeeded", job.text()
    return result(Run(folder))["summary"]


def test_the_motion_of_a_law_is_taken_over_where_only_claims_and_texts_differ(pushed: Path) -> None:
    before = result(Run(pushed))["summary"]
    assert before["motion_key"] and "reused_from" not in before
    plan, program = pushed / "plan.md", pushed / "simulation.py"
    plan.write_text(plan.read_text(encoding="utf-8").replace("claim: ", "claim: Above all, ", 1), encoding="utf-8")
    text = program.read_text(encoding="utf-8").replace('"""', '"""Told otherwise. ', 1)
    program.write_text(text.replace('sky="overcast"', 'sky="clear"'), encoding="utf-8")
    now = simulated(pushed)
    assert now["reused_from"] and now["inputs_sha256"] == before["inputs_sha256"]
