"""A force is written where the torque belongs, or the torque where the force does.

What it does: looks at writes to three of the six numbers of `xfrc_applied`, and at what the program calls the value.

Why is this bad: `xfrc_applied` has the force first and the torque last, other than the velocities of `cvel` and
mj_objectVelocity: the push turns the body on the spot.

Use instead: `data.xfrc_applied[body, :3] = force`, `data.xfrc_applied[body, 3:] = torque`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR136"
SEVERITY = "error"
HEAD = """\
import mujoco
import numpy as np
model = mujoco.MjModel.from_xml_string('<mujoco><option gravity="0 0 0"/><worldbody><geom name="wall" type="box" pos="3 0 1" size=".1 2 2"/>'
    '<body name="arm" pos="0 0 1"><joint name="arm" axis="0 0 1"/><geom name="arm" type="box" size=".4 .2 .1" mass="1"/>'
    '<site name="tip" pos=".5 0 0"/></body></worldbody><actuator><motor name="m" joint="arm" ctrlrange="-1 1"/></actuator></mujoco>')
data = mujoco.MjData(model)
"""
GOOD = (
    HEAD
    + """\
torque = np.array([0, 0, 2.0])
data.xfrc_applied[1, 3:] = torque
mujoco.mj_step(model, data, 100)
answer = data.qvel[0]
""",
    HEAD
    + """\
push = np.array([0, 1.0, 0])
arm = np.array([.5, 0, 0])
data.xfrc_applied[1, :3] = push
data.xfrc_applied[1, 3:6] = np.cross(arm, push)
mujoco.mj_step(model, data, 10)
""",
)
BAD = (
    HEAD
    + """\
torque = np.array([0, 0, 2.0])
data.xfrc_applied[1, :3] = torque
mujoco.mj_step(model, data, 100)
answer = data.qvel[0]
""",
)
EVIDENCE = Measured("nothing turns", answer, 0.5, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "force_first",
        "the first three numbers of xfrc_applied are the force, the last three the torque: here stands a {what}",
        "force to [:3], torque to [3:]",
    )
