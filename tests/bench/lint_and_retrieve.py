"""Lint and retrieval against their goals: one run, ratios to the goal (below 1 is met).

Lint: the AST rules on a 500-line program, warm; the command line, cold; the same with its world (60 free bodies) compiled
in the sandbox, compile included. Retrieve: a question, warm; the first answer of a process without any cache, index built
on the way; the same with the cache.
"""

import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Callable
from pathlib import Path

from figures import Figure, report

GOALS_S = {
    "lint 500 lines, warm": 0.050,
    "lint command, cold": 0.70,
    "lint with world, cold": 1.50,
    "search, warm": 0.040,
    "search with meaning, warm": 0.040,
    "search command, no cache": 2.0,
    "search command, cached": 0.70,
}

HEAD = """import math

import mujoco


def base():
    spec = mujoco.MjSpec()
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_PLANE, size=(50, 50, 1))
    return spec

"""
BODY = """
def part_{n}(spec, x):
    body = spec.worldbody.add_body(name="part_{n}", pos=(x, {n} * 0.1, 0.5 + 0.01 * {n}))
    body.add_freejoint(name="part_{n}_free")
    size = (0.02 + 0.001 * {n}, 0.03, 0.04)
    body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=size, mass=0.1 * {n} + 0.05, friction=(0.5, 0.005, 0.0001))
    body.add_site(name="mark_{n}", pos=(0.0, math.cos({n} / 7) * 0.01, 0.0))
    return body

"""


def program(lines: int) -> str:
    """A clean program of at least so many lines."""
    parts = [HEAD]
    while sum(part.count("\n") for part in parts) < lines - 70:
        parts.append(BODY.format(n=len(parts)))
    calls = "".join(f"    part_{n}(spec, {n}.0)\n" for n in range(1, len(parts)))
    return "".join(parts) + f"\ndef build():\n    spec = base()\n{calls}    return spec\n"


def median(action: Callable[[], object], times: int = 15) -> float:
    """Median seconds of an action."""
    taken = []
    for _ in range(times):
        began = time.perf_counter()
        action()
        taken.append(time.perf_counter() - began)
    return sorted(taken)[times // 2]


def command(*arguments: str, **environment: str) -> None:
    """Run the command line in a process of its own."""
    call = [sys.executable, "-m", "worldwright.cli", *arguments]
    subprocess.run(call, check=False, stdout=subprocess.DEVNULL, env={**os.environ, **environment})


def main() -> int:
    """Measure, print ratios, and fail when a goal is missed."""
    from worldwright.lint import tools as lint
    from worldwright.retrieve import semantic
    from worldwright.retrieve import tools as retrieve

    measured = {}
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "program.py"
        path.write_text(program(500), encoding="utf-8")
        whole = lint.check_program([path], model=True)
        assert whole.findings == () and "compiled" in whole.worlds[0], "the measured program must be clean"
        measured["lint 500 lines, warm"] = median(lambda: lint.check_program([path]))
        measured["lint command, cold"] = median(lambda: command("lint", "check-program", str(path)), 5)
        measured["lint with world, cold"] = median(lambda: command("lint", "check-program", str(path), "--model"), 5)
        questions = iter([f"sliding friction of geom {n} conveyor damping" for n in range(100)])
        retrieve.search("warm up", ranking="full_text")
        measured["search, warm"] = median(lambda: retrieve.search(next(questions), ranking="full_text"))
        if semantic.installed():
            retrieve.search("warm up", ranking="hybrid")
            both = iter([f"how does friction of geom {n} slow a conveyor" for n in range(100)])
            measured["search with meaning, warm"] = median(lambda: retrieve.search(next(both), ranking="hybrid"))
        measured["search command, cached"] = median(lambda: command("retrieve", "search", "friction"), 5)
        caches = iter(range(100))
        fresh = lambda: command("retrieve", "search", "friction", WORLDWRIGHT_CACHE=f"{folder}/{next(caches)}")  # noqa: E731
        measured["search command, no cache"] = median(fresh, 3)
    lacking = "the packaged model is not installed"
    return report(*(Figure(n, measured.get(n), goal, "s" if n in measured else lacking) for n, goal in GOALS_S.items()))


if __name__ == "__main__":
    sys.exit(main())
