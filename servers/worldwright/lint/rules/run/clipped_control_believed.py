"""A control lies beyond its range, and the program goes on as if all of it acted.

What it does: looks for controls that are clipped in every step they act in, and for clipped ones that are multiplied with
a velocity, which makes a power or a work of what never was. A program that reads `actuator_force` or `ctrlrange` knows.

Why is this bad: the engine clips without a word; the work, the power and the gains that are reported belong to no motor.

Use instead: `np.clip` to `model.actuator_ctrlrange` in the open, and `data.actuator_force` for what acted.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR129"
SEVERITY = "warning"
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
work = 0.0
for _ in range(100):
    torque = np.clip(30 * (1 - data.qpos[0]), -1, 1)
    data.ctrl[0] = torque
    work += torque * data.qvel[0] * model.opt.timestep
    mujoco.mj_step(model, data)
answer = work
""",
    HEAD
    + """\
for _ in range(300):
    data.ctrl[0] = 4 * (1 - data.qpos[0]) - 2 * data.qvel[0]
    mujoco.mj_step(model, data)
""",
)
BAD = (
    HEAD
    + """\
work = 0.0
for _ in range(100):
    torque = 30 * (1 - data.qpos[0])
    data.ctrl[0] = torque
    work += torque * data.qvel[0] * model.opt.timestep
    mujoco.mj_step(model, data)
answer = work
""",
    HEAD
    + """\
for _ in range(100):
    data.ctrl[0] = 25 * 0.5
    mujoco.mj_step(model, data)
""",
)
EVIDENCE = Measured("the work is many times what the motor did", answer, 0.05, "J")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "clipped_reckoned",
        "a control beyond its range is multiplied with a velocity: the engine clipped it, this force never acted",
        "reckon with data.actuator_force, or clip to model.actuator_ctrlrange first",
    )
    yield from run.say(
        "always_clipped",
        "what is written to ctrl lies beyond the actuator's range in every step: only the end of the range acts",
        "write values within ctrlrange, or widen it",
    )
