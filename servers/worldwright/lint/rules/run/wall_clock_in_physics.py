"""The wall clock reaches the physics.

What it does: readings of clocks are followed through arithmetic, attributes and helpers into the state and the
controls; pacing and timing are fine.

Why is this bad: the trajectory depends on the speed of the machine.

Use instead: `data.time`, the simulated seconds.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR121"
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
def phase():
    return data.time
data.ctrl[0] = phase()
answer = data.ctrl[0]
""",
)
BAD = (
    HEAD
    + """\
import time
class Gait:
    def phase(self):
        return 2 * time.time()
data.ctrl[0] = Gait().phase()
answer = data.ctrl[0]
""",
)
EVIDENCE = Measured("the control is the date", answer, 1.0, "s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say("wall_clock", "a reading of the wall clock is written into `{name}`", "use data.time")
