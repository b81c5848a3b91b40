"""The program runs for another time than the plan says.

What it does: compares the `duration` handed to `program.main` with `simulation_parameters.simulation_duration`.

Why is this bad: the duration is owned by the user; stopping early can hide what comes after, and expectations have
deadlines within it.

Use instead: the plan's number.
"""

from collections.abc import Iterator
from math import isclose

from ... import stated
from ...harm import Argued
from ...problem import Problem
from ...program_view import Program

CODE = "WL121"
SEVERITY = "error"
SCOPE = "plan"
HEAD = "from worldkit import program\ndef build():\n    return None\n"
GOOD = (HEAD + "DURATION = 3.0\nprogram.main(build, duration=DURATION)\n", HEAD + "program.main(build, duration=3)\n")
BAD = (HEAD + "program.main(build, duration=2.0)\n", HEAD + "T = 3.0 * 2\nprogram.main(build, duration=T)\n")
FIXED = (HEAD + "program.main(build, duration=3.0)\n",)
EVIDENCE = Argued("any duration simulates; that another one was approved, only the plan tells")


def check(program: Program) -> Iterator[Problem]:
    """Check every stated duration."""
    planned = program.plan.simulation_parameters.simulation_duration if program.plan else None
    if not isinstance(planned, int | float):
        return
    for value, line, node in stated.durations(program):
        if isinstance(value, int | float) and not isclose(value, planned, rel_tol=1e-9):
            fix = f"write {planned}, or change simulation_parameters.simulation_duration"
            literal = program.literal(node)
            edit = program.edit(literal, repr(planned)) if literal is not None else None
            yield Problem(f"the duration is {value:g} s, the plan says {planned:g} s", fix, line, edit=edit)
