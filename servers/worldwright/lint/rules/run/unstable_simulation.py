"""The engine gave up: the state became infinite and was reset.

What it does: looks at the engine's own warnings when time jumps back.

Why is this bad: from there on everything starts anew, and the measured rest is of another run.

Use instead: a smaller time step, `integrator="implicitfast"`, softer gains, more armature.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR123"
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
mujoco.mj_step(model, data, 10)
answer = data.time
""",
)
BAD = (
    HEAD
    + """\
for _ in range(10):
    data.qfrc_applied[0] = 1e20
    mujoco.mj_step(model, data)
answer = data.time
""",
)
EVIDENCE = Measured("the clock starts anew", answer, 0.001, "s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "unstable",
        "the simulation diverged and was reset (bad state) in this call",
        "use a smaller time step, implicitfast, softer gains, or look for the force that is too large",
    )
