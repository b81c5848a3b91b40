"""Every bench, one after the other, and one table at the end; the exit code is 1 when a figure misses its goal.

Run `python tests/bench/run.py [NAME ...]` with names of benches, or without for all. A bench that fails to run counts as
missed. Figures are wall times, or ratios of wall times of one run: on a machine that does something else they say little.
"""

import json
import os
import subprocess
import sys
import tempfile
from pathlib import Path

from figures import TO, Figure, line

HERE = Path(__file__).parent
NO_BENCH = {"run", "figures"}
ALONE = {"WORLDWRIGHT_BESIDE": "0"}
"""No walk leaves anything at work beside what is measured."""


def cores() -> int:
    """Processors that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def main(wanted: list[str]) -> int:
    """Run, then print the table."""
    known = sorted(path.stem for path in HERE.glob("*.py") if path.stem not in NO_BENCH)
    if unknown := set(wanted) - set(known):
        print(f"no such bench: {', '.join(sorted(unknown))}; there are {', '.join(known)}")
        return 2
    found: list[Figure] = []
    broken: list[str] = []
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as scratch:
        for name in wanted or known:
            path = Path(scratch) / name
            print(f"== {name}", flush=True)
            code = subprocess.run(
                [sys.executable, str(HERE / f"{name}.py")], env={**os.environ, **ALONE, TO: str(path)}, check=False
            ).returncode
            mine = [Figure(**json.loads(text)) for text in path.read_text().splitlines()] if path.exists() else []
            found += mine
            if not mine or (code and not any(figure.missed for figure in mine)):
                broken.append(name)
    print(f"\n{'figure':<44} {'value':>9}    {'goal':<8} unit  ratio   ({cores()} cores, load {load:.1f} at the start)")
    for figure in found:
        print(line(figure))
    for name in broken:
        print(f"{name:<44} did not run to its end")
    missed = sum(figure.missed for figure in found)
    idle = sum(figure.value is None for figure in found)
    met = len(found) - missed - idle
    print(f"{met} figures meet their goals; {missed} missed, {idle} not measured, {len(broken)} benches broke")
    return int(bool(missed or broken))


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
