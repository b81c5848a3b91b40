"""The columns of a state vector are taken as if it began with the positions.

What it does: knows the parts of what mj_getState and rollout fill, and looks at slices that begin at 0 and are as long as
`qpos`, or begin at `nq`.

Why is this bad: the first number is the time: every position is that of the joint before it.

Use instead: `states[..., 1:1 + model.nq]` and `states[..., 1 + model.nq:1 + model.nq + model.nv]`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR137"
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
bits = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = np.zeros(mujoco.mj_stateSize(model, bits))
data.time = 5
mujoco.mj_getState(model, data, state, bits)
answer = state[1:1 + model.nq][0]
""",
    HEAD
    + """\
bits = mujoco.mjtState.mjSTATE_QPOS | mujoco.mjtState.mjSTATE_QVEL
state = np.zeros(mujoco.mj_stateSize(model, bits))
mujoco.mj_getState(model, data, state, bits)
position = state[:model.nq]
""",
)
BAD = (
    HEAD
    + """\
bits = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = np.zeros(mujoco.mj_stateSize(model, bits))
data.time = 5
mujoco.mj_getState(model, data, state, bits)
answer = state[:model.nq][0]
""",
    HEAD
    + """\
from mujoco import rollout
bits = mujoco.mjtState.mjSTATE_FULLPHYSICS
state = np.zeros((4, mujoco.mj_stateSize(model, bits)))
states, _ = rollout.rollout(model, data, state, np.zeros((4, 10, 1)))
position = states[:, -1, :model.nq]
""",
)
EVIDENCE = Measured("the angle is the time", answer, 1.0, "rad")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "time_first",
        "the state begins with the time: these are not the columns that are meant",
        "qpos is [{qpos}], qvel [{qvel}]",
    )
