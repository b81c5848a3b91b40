"""The program does not hand its world to worldkit.

What it does: looks for a `build()` that makes the model, here or in a module beside it, and a call of `worldkit.program.main(build, …)`.

Why is this bad: without them there is no command line, no recording, no stills and no video, so no pass can run and
nothing can be proven.

Use instead: end the file with
`if __name__ == "__main__": program.main(build, duration=DURATION, movers=(…))`.
"""

from collections.abc import Iterator

from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL110"
SEVERITY = "error"
SCOPE = "contract"
GOOD = (
    (
        "from worldkit import program, scene\ndef build():\n    return scene.new('a', time_step=0.001)\n"
        "if __name__ == '__main__':\n    program.main(build, duration=2.0)\n"
    ),
    (
        "from worldkit import program as p\nfrom worldkit.scene import new\ndef world():\n return new('a', time_step=1)\n"
        "p.main(build=world, duration=2.0)\n"
    ),
    "from worldkit import program\nfrom laws.world import build\nprogram.main(build, duration=2.0)\n",
)
BAD = (
    "from worldkit import program, scene\nprogram.main(duration=1.0)\n",
    "from worldkit import scene\nspec = scene.new('a', time_step=0.001)\n",
    "from worldkit import program, scene\nprogram.main(lambda: None)\n",
    "from worldkit import program, scene\ndef build():\n    pass\nprogram.main(build, duration=1.0)\n",
)
EVIDENCE = Argued("it runs and records nothing; that a recording was expected, only the run that asked for it knows")


def check(program: Program) -> Iterator[Problem]:
    """Check the entry, its `build`, and what `build` returns."""
    import ast

    if program.films:
        return
    entry = program.entry
    if entry is None:
        fix = 'end with: if __name__ == "__main__": program.main(build, duration=DURATION)'
        yield Problem("the program never calls worldkit.program.main", fix, max(1, len(program.lines)))
        return
    if program.argument(entry, "duration") is None:
        yield at(entry, "program.main is called without a duration", "pass duration=DURATION, the plan's seconds")
    build = program.build
    if build is None and not program.built_elsewhere:
        yield at(
            entry, "program.main is called without a build function", "define build() -> mujoco.MjSpec and pass it"
        )
    elif isinstance(build, ast.FunctionDef) and not any(
        program.scopes.owner[n] is build and n.value is not None for n in program.nodes(ast.Return)
    ):
        yield at(build, f"{build.name}() returns nothing", "return the MjSpec it builds")
