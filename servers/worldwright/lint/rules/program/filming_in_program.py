"""The program of a world uses what films are described with.

What it does: finds imports of `worldkit.filming` in a program that is not `film.py`.

Why is this bad: how a world is filmed is no part of what its recording depends on, so that films can be changed without
simulating again. A world built with it would change with the film's code, and its evidence would not know.

Use instead: `worldkit.filming` in `film.py` beside the program; `worldkit.cameras` for the cameras that the plan names.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL160"
SEVERITY = "error"
SCOPE = "file"
GOOD = (
    Case("from worldkit.filming import Film\ndef film(film: Film):\n    film.mood('noon')\n", None, "film.py"),
    Case("from worldkit import cameras, scene\n", None),
)
BAD = (
    Case("from worldkit.filming import MOODS\n", None),
    Case("from worldkit import filming, scene\n", None),
    Case("import worldkit.filming.moods\n", None),
)
EVIDENCE = Argued("the key of a recording leaves worldkit.filming out")


def check(program: Program) -> Iterator[Problem]:
    """Check imports, once each."""
    import ast

    if program.films:
        return
    for node in program.nodes(ast.Import, ast.ImportFrom):
        module = f"{node.module or ''}." if isinstance(node, ast.ImportFrom) else ""
        if any(f"{module}{alias.name}.".startswith("worldkit.filming.") for alias in node.names):
            yield at(node, "worldkit.filming belongs into film.py", "move it there; plan's cameras: worldkit.cameras")
