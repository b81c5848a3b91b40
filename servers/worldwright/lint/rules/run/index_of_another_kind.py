"""An array is indexed with an address or id of something else, also through helpers, tables and loops.

What it does: follows every id and address from where it was looked up to where it is used, and compares it with what
the array is ordered by in the declarations of the installed build. An index that happens to mean the same in this
model is not reported.

Why is this bad: the number is valid, so another value is read or written: no error, wrong physics.

Use instead: `data.joint(name).qpos`, or the address array that leads from the one to the other: `jnt_qposadr`,
`jnt_dofadr`, `sensor_adr`, `actuator_ctrladr`, `body_mocapid`, `contact.efc_address`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR103"
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
def address(name):
    return model.jnt_dofadr[mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)]
data.qvel[6] = 5
answer = data.qvel[address('arm')]
""",
)
BAD = (
    HEAD
    + """\
def address(name):
    return model.jnt_qposadr[mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)]
data.qvel[6] = 5
answer = data.qvel[address('arm') - 2]
""",
    HEAD
    + """\
for j in range(model.njnt):
    data.qpos[j] = 0.1
""",
    HEAD
    + """\
site = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_SITE, 'top')
mujoco.mj_forward(model, data)
place = data.site_xpos[site].copy()
""",
)
EVIDENCE = Measured("another speed is read", answer, 1.0, "rad/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "wrong_index",
        "`{name}` is ordered by {order}, and indexed with the number of a {kind}",
        "index with the address of a {order}, or use the named access data.joint(…), data.sensor(…)",
    )
    yield from run.say(
        "missing_name",
        "a {kind} was looked up that does not exist (line {looked_up}): -1 reads the last row of `{name}`",
        "correct the name, and stop when mj_name2id returns -1",
    )
    yield from run.say(
        "compared_kinds",
        "a {one} is compared with a {other}",
        "the segmentation picture holds (object id, object type): channel 0 and channel 1",
    )
