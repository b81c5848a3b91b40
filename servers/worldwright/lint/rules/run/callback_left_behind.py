"""A global callback drives a simulation that it was not meant for.

What it does: remembers where a callback was set, and reports when a second model is stepped while it is still there.

Why is this bad: callbacks belong to the process, not to a model.

Use instead: `mujoco.set_mjcb_control(None)` in a `finally`, or writing `data.ctrl` before each step.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR118"
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
HEAD += """\
other = mujoco.MjModel.from_xml_string('<mujoco><worldbody><body><joint/><geom size=".1"/></body></worldbody></mujoco>')
"""
GOOD = (
    HEAD
    + """\
def push(m, d):
    d.qfrc_applied[:] = 1
mujoco.set_mjcb_control(push)
mujoco.mj_step(model, data)
mujoco.set_mjcb_control(None)
free = mujoco.MjData(other)
mujoco.mj_step(other, free)
answer = free.qvel[0]
""",
)
BAD = (
    HEAD
    + """\
def push(m, d):
    d.qfrc_applied[:] = 1
mujoco.set_mjcb_control(push)
mujoco.mj_step(model, data)
free = mujoco.MjData(other)
mujoco.mj_step(other, free)
mujoco.set_mjcb_control(None)
answer = free.qvel[0]
""",
)
EVIDENCE = Measured("the free joint is driven", answer, 0.01, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "callback_left",
        "{name} was set here and still drives another model on line {step}",
        "clear it with None when the simulation it is for is over",
    )
