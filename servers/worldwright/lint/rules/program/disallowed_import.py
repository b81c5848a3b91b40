"""The program imports something beyond the simulator, arrays and the runtime.

What it does: compares every import with the list a standalone program may use: mujoco, numpy, worldkit, and the parts
of the standard library that only compute.

Why is this bad: the program must run in the pinned environment, in the sandbox, on anyone's machine, and mean the same
there. Its only inputs are the catalog and its own numbers.

Use instead: worldkit's functions, or numpy. Offline preparation belongs in the catalog.
"""

import ast
from collections.abc import Iterator

from ...problem import Problem, at
from ...program import Program
from ...proof import Argued

CODE = "WL112"
SEVERITY = "error"
SCOPE = "contract"
GOOD = (
    "import math\nfrom dataclasses import field\nimport numpy as np\nimport mujoco as mj\nfrom worldkit import scene\n",
    "from __future__ import annotations\nfrom collections.abc import Iterator\n",
)
BAD = (
    "import requests\nfrom worldkit import scene\n",
    "from worldkit import scene\nimport subprocess\n",
    "from worldkit import scene\ndef build():\n    import scipy.spatial\n",
    "from worldkit import scene\nfrom . import neighbour\n",
)
EVIDENCE = Argued("what can be imported depends on the machine; the sandbox, tested in stage, has what is allowed")
_ALLOWED_WORDS = """
    __future__ abc bisect cmath collections colorsys copy dataclasses decimal enum fractions functools heapq
    itertools math mujoco numbers numpy operator random statistics string textwrap types typing worldkit
"""
ALLOWED = frozenset(_ALLOWED_WORDS.split())


def check(program: Program) -> Iterator[Problem]:
    """Every import statement, wherever it stands."""
    for node in program.nodes(ast.Import, ast.ImportFrom):
        if isinstance(node, ast.ImportFrom):
            modules = ["." * node.level + (node.module or "")]
        else:
            modules = [alias.name for alias in node.names]
        for module in modules:
            if module.split(".")[0] not in ALLOWED:
                allowed = "mujoco, numpy, worldkit, math, dataclasses, typing, collections, itertools, functools …"
                yield at(node, f"the program imports `{module}`", f"a program may import {allowed}")
