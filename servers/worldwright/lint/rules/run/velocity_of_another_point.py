"""`cvel` or a Jacobian is taken for a point it does not belong to.

What it does: `cvel` is (rotation, translation), and its translation is that of the centre of mass of the whole tree;
mj_jacBodyCom belongs to `xipos`, mj_jacBody to `xpos`. They are compared with what the engine says of the body's origin, and
with the points that the program takes.

Why is this bad: the speed of a hand is that of another point of the arm.

Use instead: `mj_objectVelocity` with the body, or a `framelinvel` sensor; `mj_jacBody` for `xpos`.
"""

from collections.abc import Iterator

from ...harm import Measured, answer
from ...observed.run_view import Run
from ...problem import Problem

CODE = "WR110"
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
data.qvel[6] = 3
mujoco.mj_forward(model, data)
out = np.zeros(6)
mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_XBODY, 2, out, 0)
answer = np.linalg.norm(out[3:])
""",
    HEAD
    + """\
out = np.zeros(6)
mujoco.mj_forward(model, data)
mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, 2, out, 0)
told = {'linear': out[3:], 'angular': out[:3]}
jacobian = np.zeros((3, model.nv))
mujoco.mj_jacSite(model, data, jacobian, None, 0)
error = np.array([1, 0, 1]) - data.site('tip').xpos
data.qvel[:] = jacobian.T @ error
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
force = np.zeros(model.nv)
point = data.xpos[2] + data.xmat[2].reshape(3, 3) @ np.array([.2, 0, 0])
mujoco.mj_applyFT(model, data, np.array([0, 1.0, 0]), np.zeros(3), point, 2, force)
""",
)
BAD = (
    HEAD
    + """\
data.qvel[6] = 3
mujoco.mj_forward(model, data)
linear = data.cvel[2][3:]
answer = np.linalg.norm(linear)
""",
    HEAD
    + """\
out = np.zeros(6)
mujoco.mj_forward(model, data)
mujoco.mj_objectVelocity(model, data, mujoco.mjtObj.mjOBJ_BODY, 2, out, 0)
told = {'linear': out[:3], 'angular': out[3:]}
""",
    HEAD
    + """\
jacobian = np.zeros((3, model.nv))
mujoco.mj_forward(model, data)
mujoco.mj_jacBody(model, data, jacobian, None, 2)
error = np.array([1, 0, 1]) - data.site('tip').xpos
data.qvel[:] = jacobian.T @ error
""",
    HEAD
    + """\
mujoco.mj_forward(model, data)
force = np.zeros(model.nv)
mujoco.mj_applyFT(model, data, np.array([0, 1.0, 0]), np.zeros(3), np.array([.2, 0, 0]), 2, force)
""",
)
EVIDENCE = Measured("the body that does not move has a speed", answer, 0.1, "m/s")


def check(run: Run) -> Iterator[Problem]:
    """Check the events of these kinds."""
    yield from run.say(
        "rotation_first",
        "the first three numbers of `{name}` are the rotation, here taken for the translation",
        "use [3:], or mj_objectVelocity for the velocity of the body's origin",
    )
    yield from run.say(
        "velocity_elsewhere",
        "the translation in `{name}` is that of the tree's centre of mass, not of this body",
        "use mj_objectVelocity(model, data, mjOBJ_XBODY, body, out, 0)",
    )
    yield from run.say(
        "com_jacobian",
        "mj_jacBodyCom belongs to the centre of mass, which is {apart:.3f} m from the body's origin that the program uses",
        "use mj_jacBody, or xipos",
    )
    yield from run.say(
        "rotation_taken_last",
        "the last three numbers of `{name}` are the translation, here taken for the rotation",
        "use [:3] for the rotation",
    )
    yield from run.say(
        "body_jacobian",
        "the Jacobian belongs to the body's {origin}, which is {apart:.3f} m from the {point} that the program uses",
        "use mj_jacSite or mj_jacGeom, or mj_jac with the point",
    )
    yield from run.say(
        "local_point",
        "this point is {apart:.3f} m from the body: it looks as if given in the body's frame, and the world's is meant",
        "xpos + xmat.reshape(3, 3) @ point",
    )
