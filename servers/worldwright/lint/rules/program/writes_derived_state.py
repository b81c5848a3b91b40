"""A quantity that the engine computes is assigned.

What it does: finds writes to fields of `MjData` that follow from the state (`xpos`, `xquat`, `geom_xpos`, `sensordata`,
`energy` …), anywhere in the program.

Why is this bad: the write has no effect on the motion: the next `mj_forward` overwrites it. Until then pictures and
recordings show a pose that no body has.

Use instead: write the state (`qpos`) once before the start, or apply forces; to move a scenery body, make it mocap and
declare it.
"""

from collections.abc import Iterator

from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program
from ._written import DERIVED, writes

CODE = "WL131"
SEVERITY = "error"
SCOPE = "any"
HEAD = "import mujoco\nmodel = mujoco.MjModel.from_xml_string('<mujoco/>')\ndata = mujoco.MjData(model)\n"
GOOD = (HEAD + "height = data.xpos[1, 2]\n", HEAD + "data.qpos[0] = 1\n", "class D:\n    pass\nd = D()\nd.xpos = 3\n")
BAD = (
    HEAD + "data.xpos[1] = [0, 0, 1]\n",
    HEAD + "data.body('crate').xpos[2] += 0.1\n",
    HEAD + "data.sensordata[:] = 0\n",
    HEAD + "import numpy as np\nnp.copyto(data.geom_xpos, 0)\n",
)
WORLD = (
    'import mujoco\nmodel = mujoco.MjModel.from_xml_string(\'<mujoco><worldbody><body pos="0 0 3"><freejoint/>'
    '<geom size=".1"/></body></worldbody></mujoco>\')\ndata = mujoco.MjData(model)\nmujoco.mj_forward(model, data)\n'
)
LIFT_POSE = WORLD + "data.xpos[1, 2] = 9\nmujoco.mj_forward(model, data)\n"
LIFT_STATE = WORLD + "data.qpos[2] = 9\nmujoco.mj_forward(model, data)\n"
EVIDENCE = Measured(
    "the body does not move", lambda s: float(executed(s)["data"].xpos[1, 2]), 1.0, "m", bad=LIFT_POSE, good=LIFT_STATE
)


def check(program: Program) -> Iterator[Problem]:
    """Check every write to a derived field."""
    for write in writes(program):
        if write.owner == "MjData" and write.field in DERIVED:
            fix = "it is computed from qpos and qvel: write the state, or apply a force"
            yield at(write.node, f"data.{write.field} is computed by the engine; writing it moves nothing", fix)
