"""What it costs to ask again for a pass that has already succeeded. Goal: under 2 % of its first cost."""

import statistics
import sys
import tempfile
import time
from pathlib import Path

from click.testing import CliRunner
from figures import Figure, report

from worldwright.cli import main as worldwright
from worldwright.stage.tools import start, wait

GOAL = 0.02
PLAN = Path(__file__).parents[2] / "examples/bouncing-basketball/plan.md"


def main() -> int:
    """Build a world once, then ask for each of its passes again; print the ratios."""
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "world"
        built = CliRunner().invoke(worldwright, ["go", str(PLAN), "--run", str(run), "--approve"])
        if built.exit_code:
            print(built.output)
            return 1
        figures = []
        for stage in ("physics", "stills", "video"):
            first = start(str(run), stage=stage).wall_s
            costs = []
            for _ in range(7):
                began = time.perf_counter()
                job = start(str(run), stage=stage)
                wait(str(run), job=job.job) if not job.ended else None
                costs.append(time.perf_counter() - began)
            ratio = statistics.median(costs) / first
            figures.append(Figure(f"{stage} again / first", ratio, GOAL))
            print(f"{stage:<8} first {first:.2f} s, again {statistics.median(costs) * 1000:.1f} ms: {ratio:.2%} of it")
    return report(*figures)


if __name__ == "__main__":
    sys.exit(main())
