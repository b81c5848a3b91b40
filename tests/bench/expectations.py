"""All expectations of each example on its recording: seconds, from the recording's folder to the verdicts.

The physics of each accepted example is run once into a temporary folder. Reading and measuring is timed in a process of
its own that has measured nothing yet (cold: with the vocabulary's imports) and again in the same process (warm).
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

from figures import Figure, report

GOAL_S = 0.3
EXAMPLES = Path(__file__).parents[2] / "examples"
TIMED = """
import json, sys, time
from worldwright.model.plan.plan_text import read_plan
from worldwright.model.recording.trajectory_files import read_trajectory
from worldwright.scan.objectives import expecting
import pathlib
plan, taken = read_plan(pathlib.Path(sys.argv[1])).plan, []
for _ in range(6):
    began = time.perf_counter()
    recorded = read_trajectory(pathlib.Path(sys.argv[2]))
    read = time.perf_counter()
    report = expecting.expect(recorded, plan)
    taken.append((read - began, time.perf_counter() - read))
count = sum(len(o.expectations) for o in report.objectives)
slow = []
for objective in report.objectives:
    for result in objective.expectations:
        began = time.perf_counter()
        expecting.measure(recorded, result.name, result.arguments)
        slow.append((time.perf_counter() - began, result.name))
print(json.dumps({
    "cold": sum(taken[0]), "read": sorted(r for r, _ in taken[1:])[2], "measure": sorted(m for _, m in taken[1:])[2],
    "rows": len(recorded.t), "bodies": len(recorded.names), "expectations": count, "ok": report.ok, "slowest": max(slow),
}))
"""


def main() -> int:
    """Measure and print."""
    worst = 0.0
    with tempfile.TemporaryDirectory() as folder:
        for example in sorted(EXAMPLES.glob("*/simulation.py")):
            out = Path(folder) / example.parent.name
            words = [sys.executable, str(example), "--pass", "physics", "--out", str(out)]
            subprocess.run(words, check=True, capture_output=True)
            plan = str(example.with_name("plan.md"))
            ran = subprocess.run(
                [sys.executable, "-c", TIMED, plan, str(out / "trajectory")], check=True, capture_output=True, text=True
            )
            said = json.loads(ran.stdout)
            warm = said["read"] + said["measure"]
            worst = max(worst, warm)
            print(
                f"{example.parent.name}: {said['expectations']} expectations, {said['rows']} rows, {said['bodies']} bodies: "
                f"{warm * 1000:.0f} ms ({said['read'] * 1000:.0f} reading, {said['measure'] * 1000:.0f} measuring, slowest "
                f"{said['slowest'][1]} {said['slowest'][0] * 1000:.1f}); the first time {said['cold'] * 1000:.0f} ms"
                + ("" if said["ok"] else "; NOT all hold")
            )
    return report(Figure("expectations of the slowest example", worst, GOAL_S, "s"))


if __name__ == "__main__":
    sys.exit(main())
