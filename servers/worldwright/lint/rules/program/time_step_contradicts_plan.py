"""The program's time step is not the plan's.

What it does: compares every time step the program sets (`scene.new(time_step=…)`, `spec.option.timestep`, MJCF) with
`simulation_parameters.time_step`.

Why is this bad: the time step is owned by the user. A program that quietly halves it to look stable proves something
about another simulation than the one that was approved.

Use instead: the plan's number. If it is unstable, say so and let the plan change.
"""

from collections.abc import Iterator
from math import isclose

from ... import stated
from ...case import Case
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL120"
SEVERITY = "error"
SCOPE = "plan"
HEAD = "from worldkit import scene\n"
GOOD = (
    HEAD + "STEP = 0.002\nspec = scene.new('a', time_step=STEP)\n",
    HEAD + "spec = scene.new('a', time_step=1 / 500)\n",
    Case("XML = '<mujoco><option timestep=\"2e-3\"/></mujoco>'\n"),
)
BAD = (
    HEAD + "STEP = 0.001\nspec = scene.new('a', time_step=STEP)\n",
    HEAD + "spec = scene.new('a', time_step=0.002)\nspec.option.timestep = 0.0005\n",
    Case("XML = '<mujoco><option timestep=\"0.01\"/></mujoco>'\n"),
)
FIXED = (
    HEAD + "STEP = 0.002\nspec = scene.new('a', time_step=STEP)\n",
    HEAD + "spec = scene.new('a', time_step=0.002)\nspec.option.timestep = 0.002\n",
)
EVIDENCE = Argued("any step simulates; that another one was approved, only the plan tells")


def check(program: Program) -> Iterator[Problem]:
    """Check every stated time step."""
    planned = program.plan.simulation_parameters.time_step if program.plan else None
    if not isinstance(planned, int | float):
        return
    for value, line, node in stated.time_steps(program):
        if isinstance(value, int | float) and not isclose(value, planned, rel_tol=1e-9):
            fix = f"write {planned}, or change simulation_parameters.time_step and have the plan approved again"
            literal = program.literal(node)
            edit = program.edit(literal, repr(planned)) if literal is not None else None
            yield Problem(f"the time step is {value:g} s, the plan says {planned:g} s", fix, line, edit=edit)
