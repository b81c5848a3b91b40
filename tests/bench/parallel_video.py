"""Video on n cores against one. Goal: at least 0.8 n times as fast.

The same recording is filmed by the program's own video pass in a process pinned to one core, then to n; its own start-up
(imports, compiling the model, the first frame's textures) is taken off by filming one frame in each setting.

    python tests/bench/parallel_video.py [--cores N]
"""

import argparse
import os
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from figures import Figure, report

GOAL = 0.8
PROGRAM = """
import sys
sys.path.insert(0, {servers!r})
from worldkit import bodies, cameras, motion, program, scene

def build():
    spec = scene.new("bench", time_step=0.002)
    names = [f"thing_{{i}}" for i in range(6)]
    for i, name in enumerate(names):
        bodies.sphere(spec, name, diameter=0.14, pos=(0.3 * (i % 3), 0.3 * (i // 3), 0.4 + 0.05 * i))
    cameras.add(spec, "overview", view="perspective", subjects=names)
    motion.launch(spec, {{"thing_0": motion.Launch(linear=(1, 0.5, 0))}})
    return spec

if __name__ == "__main__":
    raise SystemExit(program.main(build, duration=2.0, fps=24, size=(1280, 720)))
"""


def film(program: Path, recording: Path, cores: set[int]) -> float:
    """Seconds of a video pass on these cores."""
    with tempfile.TemporaryDirectory() as out:
        command = [sys.executable, str(program), "--pass", "video", "--from", str(recording), "--out", out]
        began = time.perf_counter()
        subprocess.run(
            command, check=True, stdout=subprocess.DEVNULL, preexec_fn=lambda: os.sched_setaffinity(0, cores)
        )
        return time.perf_counter() - began


def record(program: Path, folder: Path, seconds: float) -> Path:
    """The recording of a physics pass."""
    command = [sys.executable, str(program), "--pass", "physics", "--out", str(folder), "--duration", str(seconds)]
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL)
    return folder / "trajectory"


def main() -> int:
    """Measure and print."""
    mine = sorted(os.sched_getaffinity(0))
    parser = argparse.ArgumentParser()
    parser.add_argument("--cores", type=int, default=min(4, len(mine)))
    count = parser.parse_args().cores
    os.environ.setdefault("MUJOCO_GL", "egl")
    with tempfile.TemporaryDirectory() as folder:
        program = Path(folder) / "simulation.py"
        program.write_text(PROGRAM.format(servers=str(Path(__file__).parents[2] / "servers")), encoding="utf-8")
        whole = record(program, Path(folder) / "whole", 2.0)
        short = record(program, Path(folder) / "short", 0.02)
        taken = {}
        for cores in (1, count):
            chosen = set(mine[:cores])
            taken[cores] = film(program, whole, chosen) - film(program, short, chosen)
            print(f"{cores} core{'s' if cores > 1 else ''}: {taken[cores]:.2f} s for 47 more frames")
    speed = taken[1] / taken[count]
    return report(Figure(f"speed of a film on {count} cores, a core", speed / count, GOAL, "x", at_least=True))


if __name__ == "__main__":
    sys.exit(main())
