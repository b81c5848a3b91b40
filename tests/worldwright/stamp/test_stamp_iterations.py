"""Repairing is monotone: a patch that makes things worse is rolled back, the best is kept, and it ends."""

from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import GateError
from worldwright.model.evidence.journal import Journal
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.model.evidence.verdict import CrossCheck, Verdict
from worldwright.scan import tools as scan
from worldwright.stage import tools as stage
from worldwright.stamp import by_measurement, iterations
from worldwright.stamp import tools as stamp
from worldwright.stamp.state import State

Copy = Callable[[Path], Path]
END = "program.main(build,"
HELD = """program.main(build, lambda model, data: data.xfrc_applied.__setitem__((-1, 2), {}),"""  # it falls hardly
THREAD = """interventions:
  - {kind: force, bodies: [ball], law: "a thread holds it with at most 2 N along +Z", source: made up for a test}"""


def repair(run: Run, target: str = "initial_motion") -> Verdict:
    """The measured verdict on the current program, turned into an ordered repair."""
    verdict = by_measurement.review(run)
    check = CrossCheck(claim="it does not fall", channel="visual", tested_in="numeric", confirmed=True)
    changes = {"outcome": "repair", "repair_target": target, "repair": "mend it", "cross_checks": (check,)}
    return Verdict.model_validate({**verdict.model_dump(), **changes})


def iterate(folder: Path, source: str) -> str:
    """Write the program, run it and measure it; returns its key."""
    (folder / "simulation.py").write_text(source, encoding="utf-8")
    assert not [f for f in lint.check_program([folder / "simulation.py"]).findings if f.severity == "error"]
    for name in ("physics", "stills"):
        job = stage.start(str(folder), stage=name)
        while not job.ended:
            job = stage.wait(str(folder), job=job.job, timeout_s=30)
        assert job.state == "succeeded", job.text()
    scan.scan(str(folder))
    scan.expect(str(folder))
    stamp.describe(str(folder), by_measurement.describe(Run(folder)))
    return stamp.status(str(folder)).key


@pytest.fixture
def world(planned: Path, copy: Copy) -> Path:
    folder = copy(planned)
    plan = folder / "plan.md"
    text = plan.read_text(encoding="utf-8").replace("mode: cameras", "mode: none")
    plan.write_text(text.replace("inferred:", f"{THREAD}\ninferred:", 1), encoding="utf-8")
    stamp.approve(str(folder), by="tester", repairs=3)
    return folder


def test_a_worse_patch_is_rolled_back_and_repairs_end(world: Path) -> None:
    run, source = Run(world), (world / "simulation.py").read_text(encoding="utf-8")
    assert END in source
    good = iterate(world, source)
    stamp.review(str(world), repair(run, "visual_mismatch"))
    assert sha256_file(run.program) == sha256_file(run.evidence(good) / "source" / "simulation.py")

    low = source.replace(END, HELD.format(1.9))
    bad = iterate(world, low)
    assert bad != good
    answer = stamp.review(str(world), repair(run))
    assert f"worse than {good}, whose program is put back" in answer.what
    assert run.program.read_text(encoding="utf-8") == source
    status = stamp.status(str(world))
    assert status.key == good
    assert any(f"the patch of {bad} was rolled back" in note for note in status.notes)
    line = list(run.entries())[-1]
    assert (line["actor"], line["action"], line["key"], line["worse"]) == ("stamp", "roll_back", good, bad)
    assert Journal(run.journal).breaks() == []
    assert not any("outside the write scope" in note for note in status.notes)

    lower = source.replace(END, HELD.format(1.95))
    iterate(world, lower)
    answer = stamp.review(str(world), repair(run))
    assert "blocked: 3 repairs were ordered (the cap is 3)" in answer.what
    status = stamp.status(str(world))
    assert status.state == "blocked"
    assert "the world is still not right" in status.cause
    assert run.program.read_text(encoding="utf-8") == source  # the best stands where repairing ends
    assert status.next_move.startswith("worldwright stamp approve")

    run.program.write_text(source + "# a fourth patch\n", encoding="utf-8")
    lint.check_program([run.program])
    assert stamp.status(str(world)).state == "blocked"
    with pytest.raises(GateError):
        stamp.accept(str(world))
    stamp.approve(str(world), by="tester")  # a person allows more
    assert stamp.status(str(world)).state == "open"
    assert iterations.cap(State(run)) == 12


def test_the_best_so_far_follows_the_numbers_and_else_the_latest(world: Path) -> None:
    run, source = Run(world), (world / "simulation.py").read_text(encoding="utf-8")
    stamp.approve(str(world), by="tester")
    bad = iterate(world, source.replace(END, HELD.format(1.9)))
    stamp.review(str(world), repair(run))
    assert iterations.best(State(run)) == bad
    good = iterate(world, source)
    stamp.review(str(world), repair(run, "camera_placement"))
    assert iterations.best(State(run)) == good
    nearer = source.replace("    return spec", "    spec.visual.map.zfar = 60.0\n    return spec")
    same = iterate(world, nearer)  # a patch that no number shows stays
    assert "put back" not in stamp.review(str(world), repair(run, "camera_placement")).what
    assert run.program.read_text(encoding="utf-8") == nearer
    assert iterations.best(State(run)) == same
    assert f"best of 3 reviewed iterations: {same}" in stamp.status(str(world)).notes

    for key in (good, same):  # a copy that was changed is never put back
        (run.evidence(key) / "source" / "simulation.py").write_text("print()")
    assert iterations.best(State(run)) == bad
    assert not iterations.restore(State(run), good, "it was better")
    assert run.program.read_text(encoding="utf-8") == nearer


def test_in_auto_mode_a_new_approval_does_not_buy_more_repairs(tmp_path: Path) -> None:
    run = Run(tmp_path)
    run.log("stamp", "approve", auto=True, repairs=2)
    run.log("r", "review", key="a", outcome="repair")
    run.log("stamp", "approve", auto=True, repairs=2)
    run.log("r", "review", key="a", outcome="repair")
    assert not iterations.spent(State(run))
    run.log("r", "review", key="b", outcome="repair")
    assert iterations.spent(State(run))
    run.log("somebody", "approve", auto=False)
    assert not iterations.spent(State(run))
