"""A mass or a size is changed in a compiled model, and what the compiler had derived from it stays.

What it does: compares, once a body turns, the inertia of its joints with the one they would have if `body_inertia` had
been scaled like `body_mass`; and the bounds that contacts are looked for with against `geom_size`.

Why is this bad: the heavier wheel spins up as the light one did; other bodies pass through the rim of the larger shape.

Use instead: scale `body_inertia` by the same factor and call `mj_setConst`; change `geom_rbound` and `geom_aabb`, too; or
change the specification and compile it.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR132"
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
model.body_inertia[1] *= 8 / model.body_mass[1]
model.body_mass[1] = 8
mujoco.mj_setConst(model, data)
data.ctrl[0] = 1
mujoco.mj_step(model, data, 100)
mujoco.mj_step(model, data)
answer = data.qvel[0]
""",
    HEAD
    + """\
model.geom_size[0] *= .5
mujoco.mj_step(model, data, 2)
""",
    HEAD
    + """\
model.geom_pos[1] = [1, 0, 0]
model.body_ipos[1] = [1, 0, 0]
data.qvel[0] = 1
mujoco.mj_step(model, data, 2)
""",
)
BAD = (
    HEAD
    + """\
model.body_mass[1] = 8
mujoco.mj_setConst(model, data)
data.ctrl[0] = 1
mujoco.mj_step(model, data, 100)
mujoco.mj_step(model, data)
answer = data.qvel[0]
""",
    HEAD
    + """\
model.geom_size[1] *= 3
mujoco.mj_step(model, data, 2)
""",
    HEAD
    + """\
model.geom_pos[1] = [1, 0, 0]
data.qvel[0] = 1
mujoco.mj_step(model, data, 2)
""",
)
EVIDENCE = Measured("the wheel of 8 kg spins up like one of 1 kg", answer, 1.0, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "inertia_left",
        "the mass is changed and the inertia is not: the body turns as before",
        "scale model.body_inertia by the same factor",
    )
    yield from run.say(
        "bounds_left",
        "the shape grows, and the bounds that contacts are looked for with stay: its rim touches nothing",
        "change geom_rbound and geom_aabb too, or the specification",
    )
    yield from run.say(
        "mass_left",
        "the only shape of a body is moved, and its mass stays where it was",
        "change model.body_ipos too, or the specification",
    )
