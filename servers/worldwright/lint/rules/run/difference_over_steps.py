"""A difference over several steps is divided by the time of one.

What it does: differences know the simulated time between their two readings; a division by a time step that is
another span is reported.

Why is this bad: velocities and rewards too large by the number of steps.

Use instead: `model.opt.timestep * frame_skip`, or the difference of `data.time`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR124"
SEVERITY = "error"
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><worldbody><geom name="floor" type="plane" size="5 5 .1"/>'
    '<body name="ball" pos="0 0 1"><freejoint name="ball"/><geom name="ball" size=".1"/></body>'
    '<body name="arm" pos="2 0 1" euler="0 0 40"><joint name="arm" axis="0 1 0"/><geom name="arm" type="capsule" size=".03" fromto="0 0 0 .4 0 0"/>'
    '<site name="tip" pos=".4 0 0"/></body></worldbody><actuator><motor name="m" joint="arm" gear="20"/></actuator></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
before = data.qpos[2]
mujoco.mj_step(model, data, 5)
answer = (data.qpos[2] - before) / (5 * model.opt.timestep)
""",
)
BAD = (
    HEAD
    + """\
before = data.qpos[2]
mujoco.mj_step(model, data, 5)
answer = (data.qpos[2] - before) / model.opt.timestep
""",
)
EVIDENCE = Measured("the speed is five times too large", answer, 0.05, "m/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "wrong_interval",
        "a difference over {spanned} s is divided by {divided} s",
        "divide by timestep times the number of steps",
    )
