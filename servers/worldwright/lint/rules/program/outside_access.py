"""The program reaches outside itself: files, the network, other processes, the environment, or code made from text.

What it does: finds calls such as `open`, `np.load`, `exec`, `os.system`, `MjSpec.from_file`, and reads of `os.environ`.

Why is this bad: what is read from outside is not part of the evidence key, so the same program could do something else
tomorrow; what is written outside is lost by the sandbox. Constructed code cannot be reviewed.

Use instead: meshes from the catalog through `worldkit.assets.add`; constants in the program; output through the
recording that worldkit writes.
"""

import ast
from collections.abc import Iterator

from ...problem import Problem, at
from ...program import Program
from ...proof import Argued

CODE = "WL113"
SEVERITY = "error"
SCOPE = "contract"
GOOD = (
    "import numpy as np\nfrom worldkit import assets\nheights = np.linspace(0, 1, 5)\nassets.add(None, 'mug')\n",
    "from worldkit import scene\ndef open(x):\n    return x\nopen(3)\n",
)
BAD = (
    "from worldkit import scene\nopen('/etc/passwd').read()\n",
    "from worldkit import scene\nimport numpy as np\nnp.savetxt('out.csv', [1])\n",
    "from worldkit import scene\nexec('x = 1')\n",
    "from worldkit import scene\nimport os\nos.environ['HOME']\n",
    "import mujoco\nfrom worldkit import scene\nspec = mujoco.MjSpec.from_file('robot.xml')\n",
    "from worldkit import scene\nscene.__dict__['x']\n().__class__.__bases__\n",
)
EVIDENCE = Argued("the sandbox refuses it at run time; the tests of stage try every way out there")
_BUILTINS_WORDS = """
    open exec eval compile __import__ input breakpoint globals vars
"""
BUILTINS = frozenset(_BUILTINS_WORDS.split())
MODULES = ("os.", "sys.", "subprocess.", "socket.", "urllib.", "requests.", "http.", "shutil.", "pathlib.", "io.")
_FILES_NUMPY = """
    load save savez savez_compressed loadtxt savetxt genfromtxt fromfile memmap
"""
_FILES_MUJOCO = """
    MjSpec.from_file MjSpec.from_zip MjModel.from_xml_path MjModel.from_binary_path mj_saveModel mj_saveLastXML
    mj_loadPluginLibrary mj_loadAllPluginLibraries mj_printModel mj_printData
"""
FILES = tuple(f"numpy.{n}" for n in _FILES_NUMPY.split()) + tuple(f"mujoco.{n}" for n in (_FILES_MUJOCO).split())
_HIDDEN_WORDS = """
    __globals__ __builtins__ __subclasses__ __bases__ __mro__ __code__ __loader__
"""
HIDDEN = frozenset(_HIDDEN_WORDS.split())


def check(program: Program) -> Iterator[Problem]:
    """Built-ins, modules, file functions, methods that write files, and attributes that lead out of the language."""
    for call in program.nodes(ast.Call):
        name = call.func.id if isinstance(call.func, ast.Name) else ""
        if name in BUILTINS and program.scopes.scope_of(call.func) is False:
            yield at(call, f"the program calls {name}()", "keep what it needs in the program or in the catalog")
    for full, call in program.calls(*FILES, *MODULES):
        yield at(call, f"the program calls {full}", "use worldkit.assets for meshes; worldkit writes the recording")
    for node in program.nodes(ast.Attribute):
        full = program.dotted(node) or ""
        if full.startswith(("os.environ", "sys.argv", "sys.modules", "sys.path")) and full.count(".") == 1:
            yield at(node, f"the program reads {full}", "make it a constant of the program")
        elif node.attr in HIDDEN:
            yield at(node, f"the program uses {node.attr}", "say directly what is meant")
    for call in program.method_calls("to_file", "to_zip", "tofile", "write_text", "read_text", "write_bytes"):
        method = call.func.attr  # type: ignore[attr-defined]
        yield at(call, f"the program calls .{method}()", "worldkit writes the recording")
