"""What a build costs because its world is a file, and what a second build costs after a change that moves nothing.

The demo's world is built up to its stills. Told apart: how long its bundle pass takes (build, and compile once more in a clean
process) beyond what physics would take for building by itself. Then something is changed, each time on top of what stands:
a camera, the plan's text, the threshold of a claim, the renderer. Goals: the bundle costs at most a tenth of the build; the
second builds simulate no step.

    python tests/bench/second_build.py
"""

import json
import os
import sys
import tempfile
import time
from pathlib import Path

from click.testing import CliRunner
from figures import Figure, report

from worldwright.cli import main as worldwright
from worldwright.lint.tools import check_program
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run
from worldwright.stage.tools import start, wait
from worldwright.stamp.tools import approve

PLAN = Path(__file__).parents[2] / "examples/two-billiard-balls/plan.md"
GOAL = 1.1
CHANGES = {
    "camera": ("fovy: 35", "fovy: 33"),
    "text": ("Two billiard balls collide", "Two pool balls collide"),
    "threshold": ("min_m: 0.3", "min_m: 0.29"),
}
"""What is changed in the plan, in its first place: from, to."""


def main() -> int:
    """Build, change, build again; print steps and seconds."""
    with tempfile.TemporaryDirectory() as scratch:
        run = Run(Path(scratch) / "demo")
        began = time.perf_counter()
        first = told("first", run)
        whole = time.perf_counter() - began
        alone = Run(Path(scratch) / "alone")
        alone.folder.mkdir()
        for path in (run.plan, run.program):
            (alone.folder / path.name).write_bytes(path.read_bytes())
        approve(str(alone.folder), by="bench")
        check_program([alone.program])
        more = wall(run, "bundle") + wall(run, "physics") - job(alone, "physics")
        print(f"first build, up to its stills: {whole:.1f} s, {first} steps; the bundle costs {more:.2f} s of it")
        simulated = 0
        for name, (old, new) in CHANGES.items():
            text = run.plan.read_text(encoding="utf-8")
            if old not in text:
                print(f"the demo's plan is not as this script expects it: {old}")
                return 1
            run.plan.write_text(text.replace(old, new, 1), encoding="utf-8")
            simulated += told(name, run)
        os.environ["WORLDKIT_RENDERER"] = "classic"
        simulated += told("renderer", run)
    return report(
        Figure("build with a bundle / without", whole / (whole - more), GOAL),
        Figure("steps simulated by second builds", simulated, 0, "steps"),
    )


def told(name: str, run: Run) -> int:
    """Build once more; returns the steps that were simulated for it, none where a recording was taken over or stood."""
    before, began = {path.name for path in run.jobs.glob("*")}, time.perf_counter()
    build(run)
    physics = result(run, "physics")
    summary = physics["summary"]
    steps = 0 if physics["job"] in before or "reused_from" in summary else int(summary["steps"])
    print(f"{name:<10} build: {time.perf_counter() - began:6.1f} s, {steps} steps")
    return steps


def build(run: Run) -> None:
    """Go as far as the stills."""
    source = str(run.folder if run.plan.is_file() else PLAN)
    done = CliRunner().invoke(worldwright, ["go", source, "--run", str(run.folder), "--approve", "--until", "stills"])
    if done.exit_code:
        raise SystemExit(done.output)


def result(run: Run, stage: str) -> dict:
    """The result of a pass on the present program and plan."""
    folder = run.evidence(run.evidence_key(environment.current().sha256()))
    return json.loads((folder / stage / "result.json").read_text())


def wall(run: Run, stage: str) -> float:
    """Seconds of a pass."""
    return float(result(run, stage)["wall_s"])


def job(run: Run, stage: str) -> float:
    """Seconds of a pass that is run now."""
    going = start(str(run.folder), stage=stage)
    while not going.ended:
        going = wait(str(run.folder), job=going.job)
    if going.state != "succeeded":
        raise SystemExit(going.text())
    return going.wall_s


if __name__ == "__main__":
    sys.exit(main())
