"""A value is taken that the engine has not computed for the present state.

What it does: at every place where a derived value is really taken, and at every call that works on derived values,
computes them anew in a copy and compares. Only a difference counts.

Why is this bad: the old pose is used: a controller, a reward or a picture of a state that is gone.

Use instead: `mujoco.mj_forward(model, data)` between the write and the read; `mj_kinematics` and `mj_comPos` for
poses and Jacobians alone.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR104"
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
data.qpos[7] = 1
mujoco.mj_forward(model, data)
answer = data.site('tip').xpos[2]
""",
)
BAD = (
    HEAD
    + """\
mujoco.mj_forward(model, data)
data.qpos[7] = 1
answer = data.site('tip').xpos[2]
""",
    HEAD
    + """\
def tip(d):
    return d.site_xpos[0] - [0, 0, 1]
answer = tip(data)[2]
""",
)
EVIDENCE = Measured("the tip is elsewhere", answer, 0.3, "m")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "stale",
        "`{name}` is not that of the present state ({cause} written on line {wrote}; line 0: nothing was computed since data was made or reset)",
        "call mujoco.mj_forward(model, data) first",
    )
