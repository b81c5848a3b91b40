"""Joint torques are written into `ctrl` in the wrong order or without the gear.

What it does: a vector that is ordered by joints and reaches `ctrl` is compared with the order of the actuators; one
that is made of joint forces, with their gears.

Why is this bad: another motor gets the torque, or gets it fifty times over.

Use instead: `model.actuator_trnid`, `model.actuator_ctrladr` and `model.actuator_gear`, or named access.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR115"
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
mujoco.mj_forward(model, data)
torque = data.qfrc_bias[6:] / model.actuator_gear[:, 0]
data.ctrl[:] = torque
mujoco.mj_step(model, data, 2)
answer = data.qvel[6]
""",
)
BAD = (
    HEAD
    + """\
mujoco.mj_forward(model, data)
torque = data.qfrc_bias[6:] * 1
data.ctrl[:] = torque
mujoco.mj_step(model, data, 2)
answer = data.qvel[6]
""",
)
EVIDENCE = Measured("the arm is thrown", answer, 0.5, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "control_order",
        "a vector ordered by {order} is written into ctrl, and the actuators come in another order",
        "reorder it by model.actuator_trnid[:, 0]",
    )
    yield from run.say(
        "gear_ignored",
        "a joint force is written into ctrl, and the actuator's gear ({gear}) multiplies it",
        "divide by model.actuator_gear[:, 0]",
    )
