"""A repair iteration that changes only a camera: what its physics pass costs. Goal: no simulated step.

The breakfast table is simulated once for 60 s of world time; then a camera is moved, and the physics pass is asked for
again. Prints the steps that each pass simulated and their wall-clock times, and checks that the trajectory's hash and
bytes are the same. A third program changes the physics and must be simulated.
"""

import json
import sys
import tempfile
from pathlib import Path

from click.testing import CliRunner
from figures import Figure, report

from worldwright.cli import main as worldwright
from worldwright.lint.tools import check_program
from worldwright.model.evidence import environment
from worldwright.model.evidence.run import Run, sha256_file
from worldwright.stage.tools import start, wait

PLAN = Path(__file__).parents[2] / "examples/breakfast-table/plan.md"
SECONDS = 60
GOAL = 0.25
"""Of the first pass: what start-up, hashing and copying may take. Three processes start, some 3 s on two cores, whatever the
length of the world; the first pass of this one takes 14 s."""


def main() -> int:
    """Three iterations; prints what each cost."""
    with tempfile.TemporaryDirectory() as scratch:
        run = Run(Path(scratch) / "world")
        run.folder.mkdir()
        text = PLAN.read_text(encoding="utf-8").splitlines()
        longer = [
            f"simulation_duration: {SECONDS}" if line.startswith("simulation_duration:") else line for line in text
        ]
        run.plan.write_text("\n".join(longer) + "\n", encoding="utf-8")
        for verb in (
            ["place", "resolve", str(run.plan)],
            ["stamp", "approve", str(run.folder)],
            ["stage", "draft", str(run.folder)],
        ):
            done = CliRunner().invoke(worldwright, verb)
            if done.exit_code:
                print(done.output)
                return 1
        source = run.program.read_text(encoding="utf-8")
        moved = source.replace("fovy=35.0", "fovy=28.0")
        heavier = moved.replace("    return spec", "    spec.worldbody.add_site(name='mark')\n    return spec", 1)
        if len({source, moved, heavier}) != 3:
            print("the example's program is not as this script expects it")
            return 1
        first, second, third = (_physics(run, text) for text in (source, moved, heavier))
    for name, cost in (("first", first), ("camera moved", second), ("physics changed", third)):
        print(f"{name:<16} {cost['simulated']:>6} steps simulated, {cost['wall_s']:.2f} s")
    print(f"a camera repair costs {second['wall_s'] / first['wall_s']:.1%} of the first pass, and no step")
    same = second["rows"] == first["rows"] and second["sha256"] == first["sha256"]
    good = same and second["simulated"] == 0 and first["simulated"] > 0 and third["simulated"] > 0
    if not good:
        print("the camera repair was simulated again, or the repaired physics was not")
        return 1
    return report(
        Figure("steps simulated by a camera repair", second["simulated"], 0, "steps"),
        Figure("camera repair / first pass", second["wall_s"] / first["wall_s"], GOAL),
    )


def _physics(run: Run, source: str) -> dict:
    run.program.write_text(source, encoding="utf-8")
    check_program([run.program], plan=run.plan)
    job = start(str(run.folder))
    while not job.ended:
        job = wait(str(run.folder), job=job.job)
    if job.state != "succeeded":
        raise SystemExit(job.text())
    folder = run.evidence(run.evidence_key(environment.current().sha256())) / "physics"
    summary = json.loads((folder / "result.json").read_text())["summary"]
    return {
        "simulated": 0 if "reused_from" in summary else summary["steps"],
        "wall_s": job.wall_s,
        "sha256": summary["trajectory_sha256"],
        "rows": sha256_file(folder / "trajectory" / "state.arrows"),
    }


if __name__ == "__main__":
    sys.exit(main())
