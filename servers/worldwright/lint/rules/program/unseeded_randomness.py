"""A random draw is not seeded.

What it does: finds draws from the global generators of `random` and `numpy.random` that no seed precedes, generators
made without a seed, and sources that cannot be seeded (`uuid4`, `secrets`, `os.urandom`). A plain program is looked at
when it uses the engine and itself speaks of seeds: it means to be repeated. Draws from a global generator are found there
also where a method takes a `seed` and does not use it.

Why is this bad: two runs give two trajectories, so nothing that was measured can be measured again.

Use instead: `build(rng)` or `control(model, data, rng)`: worldkit passes a generator seeded with the run's seed. Or
`np.random.default_rng(SEED)`.
"""

import ast
import re
from collections.abc import Iterator
from dataclasses import replace

from ...case import Case
from ...harm import Measured, executed
from ...problem import Edit, Problem, at
from ...program_view import Program

CODE = "WL115"
SEVERITY = "error"
SCOPE = "any"
GOOD = (
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(7)\nrng.normal()\n",
    "from worldkit import scene\ndef build(rng):\n    return rng.uniform()\n",
    "import random\nfrom worldkit import scene\nrandom.seed(3)\nrandom.random()\n",
    "import random\nfrom worldkit import scene\nr = random.Random(3)\nr.random()\n",
    Case("import mujoco\nimport numpy as np\ndef start(rng=None):\n    return rng or np.random.default_rng()\n", None),
)
BAD = (
    "import numpy as np\nfrom worldkit import scene\nx = np.random.rand(3)\n",
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng()\n",
    "import random\nfrom worldkit import scene\nx = random.uniform(0, 1)\n",
    "from random import choice\nfrom worldkit import scene\nx = choice([1, 2])\n",
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(None)\n",
    "import mujoco\nimport numpy as np\ndef trial():\n    return np.random.default_rng().uniform(0.1, 3.0)\n",
    "import mujoco\nimport numpy as np\nnp.random.seed(1)\ndef reset(seed=None):\n    return np.random.rand(3)\n",
)
FIXED = (
    None,
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(0)\n",
    None,
    None,
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(0)\n",
    None,
    None,
)
SEEDED = "import numpy as np\nx = np.random.default_rng(1).random(3)\n"
EVIDENCE = Measured(
    "two runs differ", lambda s: float(abs(executed(s)["x"] - executed(s)["x"]).max()), 1e-6, good=SEEDED
)
_GENERATORS_WORDS = """
    numpy.random.default_rng numpy.random.RandomState numpy.random.SeedSequence random.Random
"""
GENERATORS = frozenset(_GENERATORS_WORDS.split())
_NOT_DRAWS_WORDS = """
    Generator PCG64 Philox SFC64 MT19937 BitGenerator seed get_state set_state getstate setstate
"""
NOT_DRAWS = frozenset(_NOT_DRAWS_WORDS.split())
SEED = re.compile(r"(?:^|_)seeds?(?:$|_)", re.IGNORECASE)


def check(program: Program) -> Iterator[Problem]:
    """Check generators without a seed, then draws from unseeded global generators."""
    if not program.contract and not _uses_engine(program):
        return
    repeated = program.contract or _means_to_be_repeated(program)
    for problem, made in _found(program):
        if repeated or (made is not None and not _fallback(program, made)):
            yield problem if program.contract else replace(problem, severity="warning")


def _uses_engine(program: Program) -> bool:
    """Whether the program uses the engine."""
    return any(full.split(".")[0] == "mujoco" for table in program.scopes.imports.values() for full in table.values())


def _means_to_be_repeated(program: Program) -> bool:
    """Whether a parameter, a name or a call of the program speaks of seeds."""
    words = (node.arg for node in program.nodes(ast.arg, ast.keyword) if node.arg)
    names = (node.id for node in program.nodes(ast.Name))
    return any(SEED.search(word) for word in (*words, *names)) or any(
        call.args for full, call in program.calls("numpy.random.", "random.") if full.endswith((".seed", "_rng"))
    )


def _seeded_method(program: Program, call: ast.Call) -> bool:
    """Whether the draw stands in a function that is given a seed: its caller expects the same draw again."""
    around = [f for f in program.scopes.chain(call) if isinstance(f, ast.FunctionDef)]
    return any("seed" in {a.arg for a in [*f.args.args, *f.args.kwonlyargs]} for f in around)


def _fallback(program: Program, call: ast.Call) -> bool:
    """Whether the generator stands in for a missing one: `rng or default_rng()`, `default_rng() if rng is None else rng`."""
    chosen = [*program.nodes(ast.BoolOp, ast.IfExp), *(child for node in program.nodes(ast.If) for child in node.body)]
    return any(call in ast.walk(node) for node in chosen)


def _found(program: Program) -> Iterator[tuple[Problem, ast.Call | None]]:
    """Generators without a seed, with the call that makes each; then draws from unseeded global generators."""
    fix = "take `rng` as a parameter of build or control, or use np.random.default_rng(SEED)"
    seeded = {full.rsplit(".", 1)[0] for full, call in program.calls("random.seed", "numpy.random.seed") if call.args}
    for full, call in program.calls("numpy.random.", "random."):
        module, _, name = full.rpartition(".")
        if full in GENERATORS:
            seed = call.args[0] if call.args else program.argument(call, "seed")
            if seed is None or (isinstance(seed, ast.Constant) and seed.value is None):
                edit = program.edit(seed, "0") if seed is not None else None
                if seed is None and not call.keywords and program.lines[(call.end_lineno or 1) - 1].isascii():
                    end = (call.end_col_offset or 1) - 1  # the seed goes before the bracket that closes the call
                    edit = Edit(call.end_lineno or 1, end + 1, call.end_lineno or 1, end + 1, "0")
                yield at(call, f"{full} is made without a seed", fix, edit=edit), call
        elif full == "random.SystemRandom":
            yield at(call, "random.SystemRandom cannot be seeded", fix), None
        elif name not in NOT_DRAWS and module in ("numpy.random", "random"):
            if module not in seeded:
                yield at(call, f"{full} draws from a global generator that nothing seeds", fix), None
            elif _seeded_method(program, call) and not _seeds_here(program, call):
                what = f"{full} draws from the global generator, and not from one of the seed given here"
                yield at(call, what, fix), None
    for full, call in program.calls("uuid.uuid1", "uuid.uuid4", "secrets.", "os.urandom"):
        yield at(call, f"{full} cannot be seeded", fix), None


def _seeds_here(program: Program, call: ast.Call) -> bool:
    """Whether the same function seeds the global generator."""
    chain = set(program.scopes.chain(call)) - {None}
    return any(
        chain & set(program.scopes.chain(other)) for _, other in program.calls("random.seed", "numpy.random.seed")
    )
