"""A value is taken that the engine computes only on demand, and nobody asked.

What it does: looks at `subtree_linvel`, `cfrc_ext`, `cacc`, `energy` and the like when they are taken: they are zero,
and are not zero when the function that fills them is called in a copy.

Why is this bad: a cost, a balance or a drift of exactly zero, which looks like success.

Use instead: the function that fills it after each step, a sensor of the quantity, or the energy flag.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR105"
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
mujoco.mj_step(model, data, 50)
mujoco.mj_subtreeVel(model, data)
answer = data.subtree_linvel[1, 2]
""",
)
BAD = (
    HEAD
    + """\
mujoco.mj_step(model, data, 50)
answer = data.subtree_linvel[1, 2]
""",
    HEAD
    + """\
mujoco.mj_step(model, data)
total = data.energy[0] + data.energy[1]
""",
)
EVIDENCE = Measured("the fall has no speed", answer, 0.5, "m/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "not_computed",
        "`{name}` is only computed by {call}, which was not called: it reads zero",
        "call mujoco.{call}(model, data) before, or enable what computes it in each step",
    )
