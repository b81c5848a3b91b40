"""The program's gravity is not the plan's.

What it does: compares every gravity the program sets (`scene.new(gravity=…)`, `spec.option.gravity`, MJCF) with
`simulation_parameters.gravity`, and names a program that leaves the default when the plan wants another one.

Why is this bad: weakened gravity makes a fall look soft and a jump look high; it changes every outcome.

Use instead: the plan's vector, in m/s^2 with z up.
"""

from collections.abc import Iterator
from math import isclose

from ... import stated
from ...case import Case
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL122"
SEVERITY = "error"
SCOPE = "plan"
HEAD = "from worldkit import scene\n"
MOON = {"simulation_parameters": {"gravity": -1.62}}
GOOD = (
    HEAD + "G = (0.0, 0.0, -9.81)\nspec = scene.new('a', time_step=0.002, gravity=G)\n",
    HEAD + "spec = scene.new('a', time_step=0.002)\n",
    Case(HEAD + "spec = scene.new('a', time_step=0.002, gravity=(0, 0, -1.62))\n", MOON),
)
BAD = (
    HEAD + "spec = scene.new('a', time_step=0.002, gravity=(0, 0, -4.9))\n",
    HEAD + "spec = scene.new('a', time_step=0.002)\nspec.option.gravity = [0, 0, 0]\n",
    Case(HEAD + "spec = scene.new('a', time_step=0.002)\n", MOON),
    HEAD + "spec = scene.new('a', time_step=0.002, gravity=(0, -9.81, 0))\n",
)
EVIDENCE = Argued("any gravity simulates; that another one was approved, only the plan tells")


def check(program: Program) -> Iterator[Problem]:
    """Check every stated gravity; the default when none is stated."""
    if program.plan is None:
        return
    planned = program.plan.simulation_parameters.gravity_vector
    shown = "({:g}, {:g}, {:g})".format(*planned)
    set_somewhere = False
    for value, line, _ in stated.gravities(program):
        set_somewhere = True
        if not _same(value, planned):
            fix = f"write {shown}, or change simulation_parameters.gravity"
            yield Problem(f"gravity is {value}, the plan says {shown} m/s^2", fix, line)
    for _, call in program.calls("worldkit.scene.new"):
        named = program.argument(call, "gravity") is not None or any(k.arg is None for k in call.keywords)
        if not named and not set_somewhere and not _same((0.0, 0.0, -9.81), planned):
            fix = f"pass gravity={shown} to scene.new"
            yield Problem(f"gravity is left at its default, the plan says {shown} m/s^2", fix, call.lineno)


def _same(value: object, planned: tuple[float, float, float]) -> bool:
    if not isinstance(value, tuple) or len(value) != 3 or not all(isinstance(v, int | float) for v in value):
        return False
    return all(isclose(a, b, rel_tol=1e-9, abs_tol=1e-12) for a, b in zip(value, planned, strict=True))
