"""A constant of the model is used after what it follows from was changed.

What it does: when `body_subtreemass`, `dof_invweight0` and the like are taken after masses, inertias or poses were
written, computes them anew in a copy and compares.

Why is this bad: the controller carries the old mass.

Use instead: `mujoco.mj_setConst(model, data)` after the change.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR114"
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
model.body_mass[1] *= 5
mujoco.mj_setConst(model, data)
answer = model.body_subtreemass[1] / model.body_mass[1]
""",
)
BAD = (
    HEAD
    + """\
model.body_mass[1] *= 5
answer = model.body_subtreemass[1] / model.body_mass[1]
""",
)
EVIDENCE = Measured("the mass is the old one", answer, 0.5)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "constants_stale",
        "{what} is of before `{name}` was changed",
        "call mujoco.mj_setConst(model, data) after the change",
    )
