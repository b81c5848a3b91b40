"""A quaternion is used in the wrong order, as plain numbers, or nudged by components.

What it does: quaternions of the engine, (w, x, y, z), and of scipy, (x, y, z, w), are told apart up to where they are
used, by the names of their parts where the program makes them; the norm of a difference of two, a small change of one
component, and vectors added to their numbers are reported.

Why is this bad: another rotation, a distance that ignores that q and -q are the same, a Jacobian of the wrong size.

Use instead: `scalar_first=True`; `mju_subQuat` or `2 * arccos(|q . p|)`; `mj_integratePos` and `mj_differentiatePos`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR112"
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
goal = np.array([-1.0, 0, 0, 0])
answer = 2 * np.arccos(min(1.0, abs(float(data.qpos[3:7] @ goal))))
""",
    HEAD
    + """\
def quaternion(yaw):
    x, y, z, w = 0.0, 0.0, np.sin(yaw / 2), np.cos(yaw / 2)
    return np.array([x, y, z, w])
data.qpos[3:7] = quaternion(0.5)[[3, 0, 1, 2]]
w, x, y, z = data.qpos[3:7]
data.qpos[3:7] = np.array([w, x, y, z])
data.qpos[:3] += np.array([0, 0, .3])
mujoco.mj_integratePos(model, data.qpos, np.array([0, 0, 0, 0, 0, .3, 0]), 1)
""",
)
BAD = (
    HEAD
    + """\
goal = np.array([-1.0, 0, 0, 0])
answer = np.linalg.norm(data.qpos[3:7] - goal)
""",
    HEAD
    + """\
def moved(q, i):
    other = q.copy()
    other[i] += 1e-6
    return other
moved(data.qpos, 4)
""",
    HEAD
    + """\
def quaternion(yaw):
    x, y, z, w = 0.0, 0.0, np.sin(yaw / 2), np.cos(yaw / 2)
    return np.array([x, y, z, w])
data.qpos[3:7] = quaternion(0.5)
""",
    HEAD
    + """\
x, y, z, w = data.qpos[3:7]
""",
    HEAD
    + """\
turned = data.qpos.copy()
turned[4:7] += np.array([0, 0, .3])
data.qpos[:] = turned
""",
)
EVIDENCE = Measured("the same rotation is far from itself", answer, 1.0)


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "quaternion_order",
        "a quaternion in the order (x, y, z, w) meets one in the order (w, x, y, z): {name}",
        "reorder it, or use scalar_first=True",
    )
    yield from run.say(
        "quaternion_difference",
        "the norm of a difference of quaternions is no distance: q and -q are the same rotation",
        "use mju_subQuat, or 2 * arccos(|q . p|)",
    )
    yield from run.say(
        "quaternion_nudged",
        "one component of a quaternion is changed by a little: that is no step of a rotation",
        "make the step in velocities: mj_integratePos(model, qpos, dv, 1)",
    )
    yield from run.say(
        "quaternion_added",
        "a rotation is added to a quaternion's numbers: that turns by another angle",
        "use mj_integratePos, mju_quatIntegrate or mju_mulQuat",
    )
