"""A random draw is not seeded.

What it does: finds draws from the global generators of `random` and `numpy.random` that no seed precedes, generators
made without a seed, and sources that cannot be seeded (`uuid4`, `secrets`, `os.urandom`).

Why is this bad: two runs give two trajectories, so nothing that was measured can be measured again.

Use instead: `build(rng)` or `control(model, data, rng)`: worldkit passes a generator seeded with the run's seed. Or
`np.random.default_rng(SEED)`.
"""

import ast
from collections.abc import Iterator

from ...problem import Edit, Problem, at
from ...program import Program
from ...proof import Measured, executed

CODE = "WL115"
SEVERITY = "error"
SCOPE = "contract"
GOOD = (
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(7)\nrng.normal()\n",
    "from worldkit import scene\ndef build(rng):\n    return rng.uniform()\n",
    "import random\nfrom worldkit import scene\nrandom.seed(3)\nrandom.random()\n",
    "import random\nfrom worldkit import scene\nr = random.Random(3)\nr.random()\n",
)
BAD = (
    "import numpy as np\nfrom worldkit import scene\nx = np.random.rand(3)\n",
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng()\n",
    "import random\nfrom worldkit import scene\nx = random.uniform(0, 1)\n",
    "from random import choice\nfrom worldkit import scene\nx = choice([1, 2])\n",
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(None)\n",
)
FIXED = (
    None,
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(0)\n",
    None,
    None,
    "import numpy as np\nfrom worldkit import scene\nrng = np.random.default_rng(0)\n",
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


def check(program: Program) -> Iterator[Problem]:
    """Generators without a seed, then draws from unseeded global generators."""
    fix = "take `rng` as a parameter of build or control, or use np.random.default_rng(SEED)"
    seeded = {full.rsplit(".", 1)[0] for full, call in program.calls("random.seed", "numpy.random.seed") if call.args}
    for full, call in program.calls("numpy.random.", "random."):
        module, _, name = full.rpartition(".")
        if full in GENERATORS:
            seed = call.args[0] if call.args else program.argument(call, "seed")
            if seed is None or (isinstance(seed, ast.Constant) and seed.value is None):
                edit = program.edit(seed, "0") if seed is not None else None
                if seed is None and not call.keywords and program.lines[(call.end_lineno or 1) - 1].isascii():
                    end = (call.end_col_offset or 1) - 1  # before the bracket that closes the call
                    edit = Edit(call.end_lineno or 1, end + 1, call.end_lineno or 1, end + 1, "0")
                yield at(call, f"{full} is made without a seed", fix, edit=edit)
        elif full == "random.SystemRandom":
            yield at(call, "random.SystemRandom cannot be seeded", fix)
        elif name not in NOT_DRAWS and module in ("numpy.random", "random") and module not in seeded:
            yield at(call, f"{full} draws from a global generator that nothing seeds", fix)
    for full, call in program.calls("uuid.uuid1", "uuid.uuid4", "secrets.", "os.urandom"):
        yield at(call, f"{full} cannot be seeded", fix)
