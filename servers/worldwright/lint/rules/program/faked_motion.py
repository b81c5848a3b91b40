"""Motion is written instead of simulated.

What it does: finds code that runs every step (`control`, callbacks, and what they call) and writes positions or
velocities of the state: `data.qpos`, `data.qvel`, `data.mocap_pos`, named access, slices and views included.

Why is this bad: the outcome does not emerge from the physics, it is animated. A written pose passes through walls, a
written velocity ignores contact, and a judge of pictures cannot tell. worldkit's ledger will record it as an
intervention anyway.

Use instead: initial velocities with `motion.launch`; forces, actuators or constraints with a law. If the plan means it
(a kinematic conveyor, a hand that carries a tool), declare it under `simulation_parameters.interventions` with kind
`pose`, `velocity` or `mocap`.
"""

from collections.abc import Iterator

from ...case import Case
from ...problem import Problem, at
from ...program import Program
from ._written import MOCAP, MOTION, POSE, writes

CODE = "WL130"
SEVERITY = "error"
SCOPE = "contract"
MAIN = "from worldkit import program\ndef build():\n    return None\n"
END = "\nprogram.main(build, control, duration=3.0)\n"
DECLARED = {"kind": "mocap", "bodies": ["crate"], "law": "x = 0.1 t", "source": "conveyor speed of the prompt"}
GOOD = (
    MAIN + "def control(model, data):\n    data.ctrl[0] = -2.0 * data.qpos[0]\n" + END,
    MAIN + "def control(model, data):\n    pass\ndef start(data):\n    data.qpos[0] = 1.0\n" + END,
    Case(
        MAIN + "def control(model, data):\n    data.mocap_pos[0, 0] = 0.1 * data.time\n" + END,
        {"simulation_parameters": {"interventions": [DECLARED]}},
    ),
)
BAD = (
    MAIN + "def control(model, data):\n    data.qpos[2] = 1.0 + data.time\n" + END,
    MAIN + "def control(model, data):\n    data.joint('crate').qvel[:] = 0\n" + END,
    MAIN
    + "def push(data):\n    data.qvel[0] += 1\ndef control(model, data):\n    push(data)\n".replace(
        "def push(data)", "def push(data: 'mujoco.MjData')"
    ).replace("from worldkit", "from worldkit", 1)
    + END
    + "import mujoco\n",
    MAIN + "def control(m, d):\n    d.mocap_pos[0] = (0, 0, d.time)\n" + END,
)


def check(program: Program) -> Iterator[Problem]:
    """Writes to the state that run every step and that the plan does not declare."""
    declared = {i.kind for i in program.plan.simulation_parameters.interventions} if program.plan else set()
    for write in writes(program):
        if write.owner != "MjData" or not program.runs_every_step(write.node):
            continue
        kind = next((k for k, f in (("pose", POSE), ("velocity", MOTION), ("mocap", MOCAP)) if write.field in f), None)
        if kind is not None and kind not in declared:
            fix = f"let forces or constraints move it, or declare an intervention of kind `{kind}` in the plan"
            yield at(write.node, f"data.{write.field} is written every step", fix)
