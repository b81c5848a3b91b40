"""A control or a force stays what it was while the program goes on as if it were renewed or over.

What it does: knows of each control of a motor at which step the state in it was read, and of each applied force when it
was last written: a feedback that was reckoned once and held, a force that is written step by step for a while and then
left on, one that is added to itself step by step.

Why is this bad: the engine clears nothing. A frozen feedback is no feedback; a push of 0.2 s lasts to the end; a force that
is added each step grows without end.

Use instead: reckon the control in the loop; write zeros to `xfrc_applied` and `qfrc_applied` when the push is over, and
before adding to them.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR130"
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
for _ in range(600):
    data.ctrl[0] = 4 * (1 - data.qpos[0]) - 2 * data.qvel[0]
    mujoco.mj_step(model, data)
answer = data.qvel[0]
""",
    HEAD
    + """\
data.xfrc_applied[1, 1] = 0.05
for _ in range(100):
    mujoco.mj_step(model, data)
""",
    HEAD
    + """\
for i in range(300):
    data.xfrc_applied[:] = 0
    if 10 < i < 40:
        data.xfrc_applied[1, 1] += 0.5
    mujoco.mj_step(model, data)
""",
    HEAD
    + """\
data.ctrl[0] = 0.3 * (1 - model.qpos0[0])
mujoco.mj_step(model, data, 300)
""",
)
BAD = (
    HEAD
    + """\
torque = 4 * (1 - data.qpos[0]) - 2 * data.qvel[0]
for _ in range(600):
    data.ctrl[0] = torque
    mujoco.mj_step(model, data)
answer = data.qvel[0]
""",
    HEAD
    + """\
for i in range(300):
    if 10 < i < 40:
        data.xfrc_applied[1, 1] = 0.5
    mujoco.mj_step(model, data)
""",
    HEAD
    + """\
for i in range(50):
    data.xfrc_applied[1, 1] += 0.01
    mujoco.mj_step(model, data)
""",
)
EVIDENCE = Measured("the arm is still driven when it should have arrived", answer, 0.5, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "feedback_frozen",
        "a control made of the state is held for {steps} steps, and the state has long moved on",
        "reckon it anew in every step",
    )
    yield from run.say(
        "force_stays",
        "`{name}` is left on: the engine does not clear it",
        "write zeros when it is over, and at each start",
    )
    yield from run.say(
        "force_piles_up",
        "this adds to what is left in `{name}` from the step before",
        "clear it before adding, or assign",
    )
