"""The program reaches for what the sandbox does not have: the network, other programs, the environment.

What it does: finds calls into the network and of other programs, reads of `os.environ` and `sys.argv`, and calls that write
files. Reading is free: helper modules and data files in the run folder, and any installed package, belong to the program and
are part of its evidence.

Why is this bad: there is no network in the sandbox and no other program to start, so the call fails there though it worked at
home; an environment differs between machines; what is written is gone with the sandbox. None of it is a danger, only a
surprise, so it is a remark.

Use instead: data in a file beside `simulation.py`, or constants; output through the recording.
"""

import ast
from collections.abc import Iterator

from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL113"
SEVERITY = "info"
SCOPE = "contract"
GOOD = (
    "import numpy as np\nfrom worldkit import assets\nheights = np.load('heights.npy')\nassets.add(None, 'mug')\n",
    "from worldkit import scene\nrows = open('track.csv').read()\n",
    "import mujoco\nfrom worldkit import scene\nspec = mujoco.MjSpec.from_file('robot.xml')\n",
    "from pathlib import Path\nfrom worldkit import scene\nimport trimesh\nPath('a.txt').read_text()\n",
)
BAD = (
    "import requests\nfrom worldkit import scene\nrequests.get('https://example.org')\n",
    "from worldkit import scene\nimport numpy as np\nnp.savetxt('out.csv', [1])\n",
    "from worldkit import scene\nimport os\nos.environ['HOME']\n",
    "from worldkit import scene\nimport subprocess\nsubprocess.run(['ls'])\n",
)
EVIDENCE = Argued("the sandbox refuses it at run time; the tests of stage try every way out there")
AWAY = (
    "subprocess.",
    "socket.",
    "urllib.request.",
    "requests.",
    "http.",
    "os.system",
    "os.popen",
    "os.exec",
    "os.spawn",
)
WRITES = tuple(f"numpy.{name}" for name in ("save", "savez", "savez_compressed", "savetxt"))


def check(program: Program) -> Iterator[Problem]:
    """Check calls, then reads of the environment."""
    for full, call in program.calls(*AWAY):
        yield at(
            call, f"the sandbox has nothing that {full} could reach", "fetch it before, into a file beside the program"
        )
    for full, call in program.calls(*WRITES):
        yield at(call, f"what {full} writes is gone with the sandbox", "worldkit writes the recording")
    for call in program.method_calls("to_file", "to_zip", "tofile", "write_text", "write_bytes"):
        method = call.func.attr  # type: ignore[attr-defined]
        yield at(call, f"what .{method}() writes is gone with the sandbox", "worldkit writes the recording")
    for node in program.nodes(ast.Attribute):
        if (read := program.dotted(node)) in ("os.environ", "sys.argv"):
            yield at(node, f"{read} differs between machines", "make it a constant of the program")
