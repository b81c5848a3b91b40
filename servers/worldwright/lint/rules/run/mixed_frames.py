"""Vectors of different frames are added, or given to an array of another frame.

What it does: every vector carries the frame that the engine gives it in (world, a body's own, a site's, a contact's),
and every matrix what it turns into what; sums, cross products, writes and turns are compared. While the frames
coincide nothing is said.

Why is this bad: the sum is of no frame at all; it works until the body turns.

Use instead: the matrix of the object (`data.xmat[body].reshape(3, 3) @ local`, its transpose for the way back);
`flg_local=0` in mj_objectVelocity.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR109"
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
data.qpos[3:7] = [.7, .7, 0, 0]
data.qvel[3:6] = [0, 0, 2]
mujoco.mj_forward(model, data)
turn = data.xmat[1].reshape(3, 3)
answer = (data.xpos[1] + turn @ data.qvel[3:6])[2]
""",
)
BAD = (
    HEAD
    + """\
data.qpos[3:7] = [.7, .7, 0, 0]
data.qvel[3:6] = [0, 0, 2]
mujoco.mj_forward(model, data)
answer = (data.xpos[1] + data.qvel[3:6])[2]
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
turn = data.body('arm').xmat.reshape(3, 3)
local = turn @ (data.site('tip').xpos - data.body('arm').xpos)
""",
)
EVIDENCE = Measured("the sum points elsewhere", answer, 0.5)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "mixed_frames",
        "a vector of frame {one} meets one of frame {other} ({name})",
        "turn one of them first: R = data.xmat[body].reshape(3, 3) takes local vectors to the world",
    )
    yield from run.say(
        "turned_twice",
        "a vector given in frame {frame} is turned by the matrix from {source} to {target}",
        "use the transpose: R.T takes world vectors into the local frame",
    )
    yield from run.say(
        "local_rotation_error",
        "the rotation error of mju_subQuat is in the local frame, the Jacobian's rows are in the world's",
        "turn it: xmat.reshape(3, 3) @ error",
    )
    yield from run.say(
        "body_force",
        "xfrc_applied takes forces in the world frame, and the body is turned",
        "turn it: data.xmat[body].reshape(3, 3) @ force",
    )
