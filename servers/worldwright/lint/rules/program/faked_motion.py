"""Motion is written instead of simulated.

What it does: finds code that runs every step (`control`, callbacks, and what they call) and writes positions or
velocities of the state: `data.qpos`, `data.qvel`, `data.mocap_pos`, named access, slices and views included.

Why is this bad: `data` is the program's own copy. What it writes there outside the inputs that the plan declares goes
nowhere; the run reports it with its line. A remark, for the author who expects something to move.

Use instead: initial velocities with `motion.launch`; forces, actuators or constraints with a law. If the plan means it
(a kinematic conveyor, a hand that carries a tool), declare it under `simulation_parameters.interventions` with kind
`pose`, `velocity` or `mocap`.
"""

from collections.abc import Iterator

from ...case import Case
from ...harm import Measured, executed
from ...problem import Problem, at
from ...program_view import Program
from ._written import MOCAP, MOTION, POSE, writes

CODE = "WL130"
SEVERITY = "info"
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
BALL = (
    "import mujoco\nspec = mujoco.MjSpec()\nball = spec.worldbody.add_body()\nball.add_freejoint()\n"
    "ball.add_geom(size=[0.1, 0, 0])\ndef control(model, data):\n    {0}\n"
)
LIFTS, FALLS = BALL.format("data.qpos[2] = data.time"), BALL.format("pass")


def _unexplained(source: str) -> float:
    """How far the ball gets in half a second without a velocity that accounts for it, m."""
    import mujoco

    space = executed(source)
    model = space["spec"].compile()
    data, way = mujoco.MjData(model), 0.0
    start = float(data.qpos[2])
    for _ in range(250):
        mujoco.mj_step1(model, data)
        space["control"](model, data)
        data.qvel[2] *= source == FALLS  # what is carried along does not also fall
        mujoco.mj_step2(model, data)
        way += float(data.qvel[2]) * model.opt.timestep
    return abs(float(data.qpos[2]) - start - way)


EVIDENCE = Measured("the ball moves without a velocity", _unexplained, 0.05, "m", good=FALLS, bad=LIFTS)


def check(program: Program) -> Iterator[Problem]:
    """Check writes to the state that run every step and that the plan does not declare."""
    declared = {i.kind for i in program.plan.simulation_parameters.interventions} if program.plan else set()
    for write in writes(program):
        if write.owner != "MjData" or not program.runs_every_step(write.node):
            continue
        kind = next((k for k, f in (("pose", POSE), ("velocity", MOTION), ("mocap", MOCAP)) if write.field in f), None)
        if kind is not None and kind not in declared:
            fix = f"let forces or constraints move it, or declare an intervention of kind `{kind}` in the plan"
            yield at(write.node, f"data.{write.field} is written every step", fix)
