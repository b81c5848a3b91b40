"""The program puts something of its own in the place of a library's function.

What it does: finds assignments to attributes of imported modules, e.g. `mujoco.mj_step2 = …`.

Why is this bad: what is replaced is replaced in the program's own process. The engine that records the world is another
process, so nothing of it changes there; here every later call runs the program's version. A remark, for it misleads a reader.

Use instead: call the function, and do one's own work in `control`.
"""

import ast
from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL118"
SEVERITY = "info"
SCOPE = "contract"
HEAD = "import mujoco\nfrom worldkit import scene\n"
GOOD = (
    HEAD + "spec = scene.new('a', time_step=0.001)\nspec.option.timestep = 0.002\n",
    HEAD + "step = mujoco.mj_step\n",
)
BAD = (
    HEAD + "mujoco.mj_step = lambda model, data: None\n",
    HEAD + "import worldengine.recording.record\nworldengine.recording.record.Recorder = None\n",
    HEAD + "setattr(mujoco, 'mj_step2', print)\n",
)


def _fallen(source: str) -> float:
    """How far a ball falls in the program's process in 100 steps, m."""
    import mujoco

    kept = mujoco.mj_step
    try:
        executed(source)
        model = mujoco.MjModel.from_xml_string(
            "<mujoco><worldbody><body><freejoint/><geom size='.1'/></body></worldbody></mujoco>"
        )
        data = mujoco.MjData(model)
        for _ in range(100):
            mujoco.mj_step(model, data)
        return float(data.qpos[2])
    finally:
        mujoco.mj_step = kept


EVIDENCE = Measured("nothing falls any more", _fallen, 0.1, "m", good=1)


def check(program: Program) -> Iterator[Problem]:
    """Check assignments, deletions and `setattr` on what leads to an import."""
    fix = "leave the library as it is: write the program's own step into control"
    for target, _, statement in program.stores():
        if isinstance(target, ast.Attribute) and (full := program.dotted(target)) is not None:
            yield at(statement, f"`{full}` is replaced", fix)
    for call in program.nodes(ast.Call):
        named = isinstance(call.func, ast.Name) and call.func.id in ("setattr", "delattr") and call.args
        if named and program.dotted(call.args[0]) is not None:
            yield at(call, f"an attribute of `{program.dotted(call.args[0])}` is replaced", fix)
