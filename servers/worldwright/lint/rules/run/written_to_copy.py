"""A write goes into a temporary copy.

What it does: finds an array picked out by a list or an array of indices and written to in the same statement
(`data.qpos[index][:] = x`).

Why is this bad: numpy copies what it picks: the state does not change.

Use instead: `data.qpos[index] = x`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR107"
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
index = np.array([7])
data.qpos[index] = 1
answer = data.qpos[7]
""",
)
BAD = (
    HEAD
    + """\
index = np.array([7])
data.qpos[index][:] = 1
answer = data.qpos[7]
""",
)
EVIDENCE = Measured("the joint does not move", answer, 0.5, "rad")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "written_to_copy",
        "`{name}[…][…] = …` writes into a temporary copy: nothing changes",
        "index once: {name}[index] = value",
    )
