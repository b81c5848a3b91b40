"""The world as one file, a pass of its own: built once, then linted, simulated and filmed as that file."""

import json
from collections.abc import Callable
from pathlib import Path

import pytest

from worldwright.lint import tools as lint
from worldwright.model.errors import GateError
from worldwright.model.evidence import environment, rounding
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.place import tools as place
from worldwright.stage import tools as stage
from worldwright.stage import variants
from worldwright.stamp import tools as stamp
from worldwright.stamp.going import Going

Copy = Callable[[Path], Path]
COUNTS = """
import os
from pathlib import Path

_build = build


def build() -> mujoco.MjSpec:
    print("this is the build of the world")
    return _build()


if __name__ == "__main__":"""


def ended(folder: Path, name: str, **options: object):
    job = stage.start(str(folder), stage=name, **options)
    while not job.ended:
        job = stage.wait(str(folder), job=job.job, timeout_s=30)
    return job


def here(folder: Path) -> Path:
    run = Run(folder)
    return run.evidence(run.evidence_key(environment.current().sha256()))


def builds(folder: Path) -> int:
    """How often the jobs of a run have built its world: each build prints a line into its job's log."""
    return sum("this is the build of the world" in log.read_text() for log in folder.glob("jobs/*/log.txt"))


@pytest.fixture
def counting(planned: Path, copy: Copy) -> Path:
    """A planned run, whose program tells when it builds."""
    folder = copy(planned)
    program = folder / "simulation.py"
    program.write_text(program.read_text().replace('if __name__ == "__main__":', COUNTS.lstrip("\n")))
    return folder


def test_it_needs_an_approved_plan_and_no_lint(counting: Path) -> None:
    with pytest.raises(GateError, match="bundle pass needs an approval"):
        stage.start(str(counting), stage="bundle")
    stamp.approve(str(counting), by="tester")
    job = ended(counting, "bundle")
    assert job.state == "succeeded", job.text()
    result = json.loads((here(counting) / "bundle" / "result.json").read_text())
    assert set(result["files"]) >= {"world.mjz", "program.json", "inputs.json"}
    assert result["summary"]["world_sha256"] == sha256_file(here(counting) / "bundle" / "world.mjz")
    assert ended(counting, "bundle").cached


def test_one_build_serves_lint_physics_and_its_variants(counting: Path) -> None:
    stamp.approve(str(counting), by="tester")
    ended(counting, "bundle")
    report = lint.check_program([counting / "simulation.py"])
    assert any("world.mjz" in said or "compiled" in said for said in report.worlds)
    assert ended(counting, "physics").state == "succeeded"
    assert variants.run(Run(counting), "half", ("--time-step-factor", "0.5"), timeout_s=60).state == "succeeded"
    assert builds(counting) == 1
    assert sha256_file(here(counting) / "physics" / "world.mjz") == sha256_file(here(counting) / "bundle" / "world.mjz")


def test_without_it_physics_builds(counting: Path) -> None:
    stamp.approve(str(counting), by="tester")
    lint.check_program([counting / "simulation.py"])
    assert ended(counting, "physics").state == "succeeded"
    assert builds(counting) == 1


def test_going_builds_once(counting: Path) -> None:
    gone = Going(
        Run(counting), until="physics", approve=lambda: stamp.approve(str(counting), by="tester") and "yes"
    ).go()
    assert "physics" in gone.held, gone
    assert builds(counting) == 1


def test_a_bundle_that_was_changed_is_built_anew(counting: Path) -> None:
    stamp.approve(str(counting), by="tester")
    ended(counting, "bundle")
    world = here(counting) / "bundle" / "world.mjz"
    world.write_bytes(world.read_bytes() + b"\0")
    lint.check_program([counting / "simulation.py"])
    assert ended(counting, "physics").state == "succeeded"
    assert builds(counting) == 2


LIAR = '''
_build = build


def build() -> mujoco.MjSpec:
    """Another world for whoever only looks."""
    spec = _build()
    if "--pass" not in sys.argv:
        spec.option.gravity = (0, 0, -1.0)
    return spec


if __name__ == "__main__":'''


def test_a_program_that_shows_lint_another_world_is_judged_by_the_one_it_simulates(planned: Path, copy: Copy) -> None:
    """Without a bundle lint sees what the program shows it; with one it sees what is simulated."""
    folder = copy(planned)
    program = folder / "simulation.py"
    text = program.read_text().replace('if __name__ == "__main__":', LIAR.lstrip("\n"))
    program.write_text(text.replace("import mujoco\n", "import sys\n\nimport mujoco\n", 1))
    stamp.approve(str(folder), by="tester")
    alone = {f.code for f in lint.check_program([program]).findings if f.severity == "error"}
    assert ended(folder, "bundle").state == "succeeded"
    bundled = {f.code for f in lint.check_program([program]).findings if f.severity == "error"}
    assert alone - bundled == {"WM155"}  # the gravity


def test_a_build_that_fails_is_told_by_lint_with_its_line(counting: Path) -> None:
    program = counting / "simulation.py"
    program.write_text(program.read_text().replace("    return _build()", '    raise RuntimeError("no such thing")'))
    stamp.approve(str(counting), by="tester")
    job = ended(counting, "bundle")
    assert job.state == "failed" and "no such thing" in job.text()
    gone = Going(Run(counting), until="lint").go()
    assert gone.state == "stopped" and any("no such thing" in wrong.what for wrong in gone.wrong)


def test_place_check_looks_at_the_world_that_is_built(planned: Path, copy: Copy) -> None:
    """Before there is one, and for another program, it knows the plan alone."""
    folder = copy(planned)
    program = folder / "simulation.py"
    sunk = program.read_text().replace("pos=(0.0, 0.0, 0.5)", "pos=(0.0, 0.0, 0.02)")
    assert sunk != program.read_text()
    program.write_text(sunk)
    stamp.approve(str(folder), by="tester")
    assert place.check(folder / "plan.md").ok
    assert ended(folder, "bundle").state == "succeeded"
    report = place.check(folder / "plan.md")
    assert [f.code for f in report.findings if f.severity == "error"] == ["WP326"]
    assert "in the built world, `ball` and `world` start" in report.text()
    layout = here(folder) / "bundle" / "layout.json"
    whole = layout.read_bytes()
    layout.write_bytes(whole.replace(b"contacts", b"contents"))
    assert place.check(folder / "plan.md").ok  # nobody vouches for it any more
    layout.write_bytes(whole)
    program.write_text(sunk + "\n# another\n")
    assert place.check(folder / "plan.md").ok


def test_what_the_file_holds_rounded_is_told_in_one_line(counting: Path) -> None:
    program = counting / "simulation.py"
    frame = """    spec = _build()
    far = spec.worldbody.add_body(name="far", pos=(0.3, 7, 0.1))
    far.set_frame(spec.worldbody.add_frame(quat=(0.9, 0.1, 0.2, 0.3), pos=(0.1, 0.2, 0.3)))
    return spec"""
    program.write_text(program.read_text().replace("    return _build()", frame))
    stamp.approve(str(counting), by="tester")
    job = ended(counting, "bundle")
    assert job.state == "succeeded", job.text()
    summary = json.loads((here(counting) / "bundle" / "result.json").read_text())["summary"]
    told = rounding.told(summary)
    assert "body_pos by" in told and "rounded in the world's file" in told and "\n" not in told
    assert 0 < max(summary["rounded"].values()) < 1e-12


def test_the_largest_roundings_are_told_first_and_nonsense_is_not() -> None:
    assert rounding.told({}) == rounding.told({"rounded": {}}) == rounding.told({"rounded": 3}) == ""
    told = rounding.told({"rounded": {f"field_{n}": n * 1e-9 for n in range(1, 8)}})
    assert told.index("field_7 by 7e-09") < told.index("field_3 by 3e-09") and told.endswith("and 2 more of its size")
