"""A list that is meant to hold many states holds one many times.

What it does: looks at each list made by repetition or by a loop: the same MjData in all places, also within environments.

Why is this bad: every "parallel" environment steps and resets all the others.

Use instead: `[mujoco.MjData(model) for _ in range(n)]`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR133"
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
states = [mujoco.MjData(model) for _ in range(3)]
for state in states:
    mujoco.mj_step(model, state)
answer = states[0].time
""",
)
BAD = (
    HEAD
    + """\
states = [mujoco.MjData(model)] * 3
for state in states:
    mujoco.mj_step(model, state)
answer = states[0].time
""",
    HEAD
    + """\
class Env:
    def __init__(self, data):
        self.data = data
    def step(self):
        mujoco.mj_step(model, self.data)
for env in [Env(data) for _ in range(3)]:
    env.step()
""",
)
EVIDENCE = Measured("the clock of the first runs three times as fast", answer, 0.003, "s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "one_state_listed",
        "all {times} elements are one and the same MjData",
        "make one for each: [mujoco.MjData(model) for _ in range(n)]",
    )
