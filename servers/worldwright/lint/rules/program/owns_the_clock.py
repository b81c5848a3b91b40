"""The program steps or renders the simulation itself.

What it does: finds calls that advance, reset or draw the simulation (`mj_step`, `mj_resetData`, `Renderer`, a viewer)
in a program that worldkit runs.

Why is this bad: the engine owns the clock, in a process of its own. What the program steps or draws for itself is nobody's
evidence and takes time; to settle a pile in a copy of the model before it is handed over is a good reason for it. So it is a
remark.

Use instead: build the model in `build()`, act in `control(model, data)`, film with `cameras.add`.
"""

from collections.abc import Iterator

from ...harm import Argued
from ...problem import Problem, at
from ...program_view import Program

CODE = "WL111"
SEVERITY = "info"
SCOPE = "contract"
GOOD = (
    (
        "import mujoco\nfrom worldkit import program\ndef control(model, data):\n    data.ctrl[0] = 1.0\n"
        "program.main(None, control)\n"
    ),
    "import mujoco\nfrom worldkit import program\nmujoco.mju_normalize3\n",
)
BAD = (
    "import mujoco\nfrom worldkit import program\nfor _ in range(100):\n    mujoco.mj_step(None, None)\n",
    "import mujoco\nfrom worldkit import program\nr = mujoco.Renderer(None)\n",
    "import mujoco.viewer\nfrom worldkit import program\nmujoco.viewer.launch(None)\n",
)
EVIDENCE = Argued("its steps and pictures are real; the harm is that no pass records them, so nothing can be proved")
STEPS = tuple(
    f"mujoco.{name}"
    for name in ("mj_step", "mj_step1", "mj_step2", "mj_resetData", "mj_resetDataKeyframe", "mj_Euler", "mj_RungeKutta")
) + tuple(f"mujoco.{name}" for name in ("mj_implicit", "mj_advance", "mj_setState", "mj_copyData"))
DRAWS = ("mujoco.Renderer", "mujoco.MjrContext", "mujoco.mjr_render", "mujoco.mjv_updateScene")
WHOLE = ("mujoco.viewer.", "mujoco.studio.", "mujoco.rollout.", "mujoco.batch.")


def check(program: Program) -> Iterator[Problem]:
    """Check every call that advances time, restores a state, or draws."""
    for full, call in program.calls(*STEPS, *WHOLE):
        yield at(call, f"the program calls {full} itself", "leave the clock to worldkit.program.main")
    for full, call in program.calls(*DRAWS):
        yield at(call, f"the program renders itself ({full})", "add a camera with worldkit.cameras.add")
