"""A film defines no `film(film)`.

What it does: looks in `film.py` for a function called `film` that takes one argument.

Why is this bad: the function is all that is asked for; without it the video pass stops, and no picture shows why.

Use instead: `def film(film: Film) -> None:` with the calls that say what is shown.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL159"
SEVERITY = "error"
SCOPE = "file"
FILM = "film.py"
GOOD = (
    Case("from worldkit.filming import Film\ndef film(film: Film) -> None:\n    film.mood('noon')\n", None, FILM),
    Case("from worldkit.filming import Film, follow\ndef film(f):\n    f.shot(follow('ball'), until=1)\n", None, FILM),
    Case("import mujoco\n", None, "other.py"),
)
BAD = (
    Case("from worldkit.filming import Film\nFilm.mood('noon')\n", None, FILM),
    Case("from worldkit.filming import Film\ndef film() -> None:\n    pass\n", None, FILM),
)
EVIDENCE = Argued("the video pass refuses it; tests of stage show the refusal")


def check(program: Program) -> Iterator[Problem]:
    """Check the function, and its one argument."""
    import ast

    if not program.films or program.source.problem is not None:
        return
    told = [node for node in program.tree.body if isinstance(node, ast.FunctionDef) and node.name == "film"]
    fix = "def film(film: Film) -> None: …"
    if not told:
        yield Problem("film.py defines no function film(film)", fix, max(1, len(program.lines)))
    elif len(told[-1].args.args) != 1:
        yield at(told[-1], "film() is called with one argument, the Film", fix)
