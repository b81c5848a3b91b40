"""Each episode changes the model from where the last one left it.

What it does: follows each change of a model's array that begins from its present value (`*=`, `+=`, a product of what was
just read) over the starts of the program. What is put back from a copy in between, or changed by the same amount in a
sweep outside any reset, is left alone.

Why is this bad: 100 draws of plus or minus 30 % multiply: the mass walks from 2 kg to 0.4 or 6.7 kg.

Use instead: copy the nominal values once, and write `model.body_mass[:] = nominal * scale`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR131"
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
rng = np.random.default_rng(0)
mass = model.body_mass.copy()
for _ in range(40):
    mujoco.mj_resetData(model, data)
    model.body_mass[:] = mass * rng.uniform(.5, 1.0)
    mujoco.mj_step(model, data)
answer = model.body_mass[1]
""",
    HEAD
    + """\
rng = np.random.default_rng(0)
mass = model.body_mass.copy()
for _ in range(5):
    mujoco.mj_resetData(model, data)
    model.body_mass[:] = mass
    model.body_mass[1] *= rng.uniform(.5, 1.0)
    mujoco.mj_step(model, data)
""",
    HEAD
    + """\
rng = np.random.default_rng(0)
for _ in range(50):
    model.body_mass[1] *= 1 - rng.uniform(0, .001)
    mujoco.mj_step(model, data)
""",
)
BAD = (
    HEAD
    + """\
rng = np.random.default_rng(0)
for _ in range(40):
    mujoco.mj_resetData(model, data)
    model.body_mass[:] *= rng.uniform(.5, 1.0)
    mujoco.mj_step(model, data)
answer = model.body_mass[1]
""",
    HEAD
    + """\
def reset():
    model.body_mass[1] = model.body_mass[1] + 0.2
    mujoco.mj_resetData(model, data)
for _ in range(4):
    reset()
    mujoco.mj_step(model, data)
""",
)
EVIDENCE = Measured("the mass has gone", answer, 0.3, "kg")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "change_piles_up",
        "this change begins from what the last episode left: the values walk away",
        "keep a copy of the nominal values and scale that",
    )
